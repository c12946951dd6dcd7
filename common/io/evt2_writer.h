#pragma once

#include <cstdint>

#include "common/io/file_event_writer.h"

namespace puck {

/// Prophesee RAW, EVT 2.0. Its time is 34 bits wide; later first times and longer pauses are
/// counted through.
class Evt2Writer final : public FileEventWriter {
 public:
  /// Writes the header. Throws EventFileError, std::invalid_argument for an invalid sensor.
  Evt2Writer(const std::filesystem::path& path, SensorSize sensor);

  void write(const EventPacket& packet) override;

 private:
  std::int64_t high_ = -1;  // Unwrapped; −1: no time word yet.
};

}  // namespace puck
