#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string_view>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"

namespace puck {

/// Writes events to a file. One thread at a time.
class EventWriter {
 public:
  virtual ~EventWriter() = default;

  /// Throws std::invalid_argument for an event outside the sensor or older than the previous one,
  /// and for a time that the format cannot hold; EventFileError when the file cannot be written.
  virtual void write(const EventPacket& packet) = 0;

  /// Writes the rest. Throws EventFileError when that fails; the destructor also closes, but
  /// ignores errors.
  virtual void close() = 0;
};

/// A format that can be written.
struct WrittenFormat {
  std::string_view name;
  std::string_view
      ending;  ///< Of the files that are written so unless another format is asked for.
  std::string_view usual_ending;  ///< Of files in it, also if the ending alone means another.
  std::string_view what;
};

inline constexpr std::array<WrittenFormat, 10> kWrittenFormats{{
    {"evt3", ".raw", ".raw", "Prophesee RAW, EVT3"},
    {"evt2", "", ".raw", "Prophesee RAW, EVT2"},
    {"evt21", "", ".raw", "Prophesee RAW, EVT2.1, little-endian words"},
    {"dat", ".dat", ".dat", "Prophesee DAT, version 2"},
    {"hdf5", ".hdf5", ".hdf5", "HDF5 in Prophesee's layout, gzip"},
    {"hdf5-ecf", "", ".hdf5", "HDF5 in Prophesee's layout, ECF"},
    {"aedat4", ".aedat4", ".aedat4", "AEDAT4, LZ4"},
    {"es", ".es", ".es", "Event Stream of a DVS"},
    {"csv", ".csv", ".csv", "text: t,x,y,p, t in µs"},
    {"text", ".txt", ".txt", "text: t x y p, t in µs"},
}};

/// The name of the format that the path's ending means; `.h5` is HDF5, too. Throws EventFileError
/// for another ending.
std::string_view format_of_ending(const std::filesystem::path& path);

/// `path` "-" is standard output. `format`: a name of kWrittenFormats, or empty: from the path's
/// ending. Throws EventFileError for another format, an invalid sensor, or a file that cannot be
/// written.
std::unique_ptr<EventWriter> make_event_writer(const std::filesystem::path& path,
                                               std::string_view format, SensorSize sensor);

}  // namespace puck
