#pragma once

#include <cstdint>

#include "common/io/file_event_writer.h"

namespace puck {

/// Prophesee RAW, EVT 2.1, in words of 64 bits, little-endian, of up to 32 pixels of a row. Its
/// time is 34 bits wide; later first times and longer pauses are counted through.
class Evt21Writer final : public FileEventWriter {
 public:
  /// Writes the header. Throws EventFileError, std::invalid_argument for an invalid sensor.
  Evt21Writer(const std::filesystem::path& path, SensorSize sensor);

  void write(const EventPacket& packet) override;

 private:
  std::int64_t high_ = -1;  // Unwrapped; −1: no time word yet.
};

}  // namespace puck
