#pragma once

#include "common/io/event_writer.h"
#include "common/io/output_file.h"

namespace puck {

/// One event a line, t in µs, after a line `%geometry:WIDTH,HEIGHT` and one of the columns' names.
class TextEventWriter final : public EventWriter {
 public:
  enum class Form {
    kBlanks,  ///< `t x y p`.
    kCommas,  ///< `t,x,y,p`.
  };

  /// Writes the header. Throws EventFileError, std::invalid_argument for an invalid sensor.
  TextEventWriter(const std::filesystem::path& path, SensorSize sensor, Form form);
  ~TextEventWriter() override;

  void write(const EventPacket& packet) override;
  void close() override;

 private:
  SensorSize sensor_;
  char separator_;
  OutputFile file_;
  Timestamp newest_{0};
};

}  // namespace puck
