#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/io/byte_source.h"
#include "common/io/event_decoder.h"
#include "common/io/one_line.h"

namespace puck {

/// An error of an event file or stream, in one line that names it and what was expected.
class EventFileError : public std::runtime_error {
 public:
  explicit EventFileError(const std::string& message) : std::runtime_error(one_line(message)) {}
};

/// Nothing states the size of a file's sensor.
class SensorUnknownError final : public EventFileError {
 public:
  using EventFileError::EventFileError;
};

/// Properties of a file that the file itself does not state, and how to read it.
struct EventFileOptions {
  /// One of kEventFormats; matters only where the content does not tell the format.
  std::string from;
  /// For files that do not state their sensor's size; {0, 0}: unknown.
  SensorSize sensor;
  /// For files of which nothing tells the sensor's size, such as the size model's sensor; {0, 0}:
  /// unknown.
  SensorSize fallback_sensor;
  /// Events up to so many µs out of order are put in order; older ones are dropped and counted.
  /// From 0 to kMostReorderUs. In a live stream it delays every event.
  std::int64_t reorder_us = kUsualReorderUs;

  /// Text: the order of time, x, y and polarity, with any of ` ,;` between the letters; a line of
  /// column names in the file overrides it.
  std::string text_columns = "t x y p";
  /// Text: "s", "ms", "us", "ns", or "auto": by the column's name, else by the numbers.
  std::string text_unit = "auto";
  /// Text: separator of the columns; "auto": any run of spaces, tabs, `,` and `;`.
  std::string text_separator = "auto";

  /// YARP log: the eye whose events are read: "left", "right", or "auto": the one with more events
  /// at the beginning.
  std::string yarp_eye = "auto";

  /// Ends a wait for a pipe; must outlive the reader. Null: none.
  const Interruption* interruption = nullptr;

  static constexpr std::int64_t kUsualReorderUs = 1000;
  static constexpr std::int64_t kMostReorderUs = 1'000'000;
};

/// What a file says of itself.
struct RecordingFacts {
  std::string encoding;  ///< "EVT3", "AEDAT4, LZ4", …; empty if the reader does not tell.
  std::vector<std::pair<std::string, std::string>> header;  ///< Keys and values, in its order.
};

/// The events of a file in the order of their times, which are the file's, without an offset. One
/// thread at a time.
class EventReader {
 public:
  /// Default packet size: few calls, little memory.
  static constexpr std::size_t kUsualEvents = 4096;

  virtual ~EventReader() = default;

  virtual SensorSize sensor_size() const = 0;

  /// Replaces the events in `packet` by the next ones, at most `max_events` (1 or more), reusing
  /// its memory. Returns false at the end of the file; the packet is then empty. Throws
  /// EventFileError when the file cannot be read to its end, or holds a line that is not an event.
  virtual bool read(EventPacket& packet, std::size_t max_events) = 0;

  /// Whether rewind() works: not for pipes.
  virtual bool can_rewind() const = 0;

  /// Starts again from the first event, with new counters and warnings. Throws EventFileError where
  /// it cannot; read() then goes on where it was, or throws too.
  virtual void rewind() = 0;

  /// Counts of read and dropped events so far.
  virtual const EventCounters& counters() const = 0;

  virtual RecordingFacts facts() const { return {}; }

  /// Number of the session to which the last packet belongs, from 0 on: an LCM log may hold several
  /// ones. Their times are joined.
  virtual std::int64_t session_number() const { return 0; }

  /// Share of the file that was read, 0 to 1; nothing for a stream of unknown length.
  virtual std::optional<double> share_read() const { return std::nullopt; }

  /// Faults of the file, one line each; complete once `read` has returned false.
  virtual std::vector<std::string> warnings() const = 0;
};

/// Opens an event file of any format that docs/formats.md lists, plain or within gzip or zstd; "-"
/// is standard input. Where nothing tells the sensor's size, reads a file once more to take it from
/// the events. Throws EventFileError for a file that is missing, empty, or of another format, and
/// SensorUnknownError for a stream without a sensor's size.
std::unique_ptr<EventReader> open_event_file(const std::filesystem::path& path,
                                             const EventFileOptions& options = {});

/// The same for the bytes of `path`, of which nothing may have been read.
std::unique_ptr<EventReader> open_event_bytes(std::unique_ptr<ByteSource> bytes,
                                              const std::filesystem::path& path,
                                              const EventFileOptions& options = {});

/// Throws EventFileError where there is no such file, for tools that read other files first.
void check_recording_exists(const std::filesystem::path& path);

}  // namespace puck
