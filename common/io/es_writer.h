#pragma once

#include "common/io/event_checks.h"
#include "common/io/file_event_writer.h"

namespace puck {

/// Event Stream 2.0 of a DVS (.es), where y counts upwards. It stores the time since the event
/// before, and a byte for each 127 µs of a pause.
class EsWriter final : public FileEventWriter {
 public:
  /// Longer pauses and later first times would fill the file: this one takes 28 MB.
  static constexpr std::int64_t kLongestPauseUs = std::int64_t{3600} * 1000000;

  /// Writes the header. Throws EventFileError, std::invalid_argument for an invalid sensor.
  EsWriter(const std::filesystem::path& path, SensorSize sensor);

  /// Throws std::invalid_argument also for a pause, or a first time, of more than kLongestPauseUs,
  /// and as PauseSum.
  void write(const EventPacket& packet) override;

 private:
  PauseSum pauses_;
};

}  // namespace puck
