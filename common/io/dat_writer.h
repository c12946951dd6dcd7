#pragma once

#include "common/io/file_event_writer.h"

namespace puck {

/// Prophesee DAT, version 2. Its time is 32 bits wide (71.6 min) and wraps.
class DatWriter final : public FileEventWriter {
 public:
  /// A longer pause could be half a wrap or more, which no reader can tell.
  static constexpr std::int64_t kLongestPauseUs = (std::int64_t{1} << 31) - 1;

  /// Writes the header. Throws EventFileError, std::invalid_argument for an invalid sensor.
  DatWriter(const std::filesystem::path& path, SensorSize sensor);

  /// Throws std::invalid_argument also for a first time that needs more than 32 bits and for a
  /// pause of more than kLongestPauseUs.
  void write(const EventPacket& packet) override;

 private:
  bool is_first_ = true;
};

}  // namespace puck
