#pragma once

#include <cstdint>

#include "common/io/event_writer.h"
#include "common/io/output_file.h"

namespace puck {

/// Prophesee RAW, EVT 2.0. Its time is 34 bits wide; later first times and longer pauses are
/// counted through.
class Evt2Writer final : public EventWriter {
 public:
  /// Writes the header. Throws EventFileError, std::invalid_argument for an invalid sensor.
  Evt2Writer(const std::filesystem::path& path, SensorSize sensor);
  ~Evt2Writer() override;

  void write(const EventPacket& packet) override;
  void close() override;

 private:
  SensorSize sensor_;
  OutputFile file_;
  Timestamp newest_{0};
  std::int64_t high_ = -1;  // Unwrapped; −1: no time word yet.
};

}  // namespace puck
