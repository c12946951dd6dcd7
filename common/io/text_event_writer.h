#pragma once

#include "common/io/event_writer.h"
#include "common/io/output_file.h"

namespace puck {

/// One `t x y p` a line, t in µs, after a line `%geometry:WIDTH,HEIGHT`.
class TextEventWriter final : public EventWriter {
 public:
  /// Writes the header. Throws EventFileError, std::invalid_argument for an invalid sensor.
  TextEventWriter(const std::filesystem::path& path, SensorSize sensor);
  ~TextEventWriter() override;

  void write(const EventPacket& packet) override;
  void close() override;

 private:
  SensorSize sensor_;
  OutputFile file_;
  Timestamp newest_{0};
};

}  // namespace puck
