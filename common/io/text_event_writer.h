#pragma once

#include "common/io/file_event_writer.h"

namespace puck {

/// One event a line, t in µs, after a line `%geometry:WIDTH,HEIGHT` and one of the columns' names.
class TextEventWriter final : public FileEventWriter {
 public:
  enum class Form {
    kBlanks,  ///< `t x y p`.
    kCommas,  ///< `t,x,y,p`.
  };

  /// Writes the header. Throws EventFileError, std::invalid_argument for an invalid sensor.
  TextEventWriter(const std::filesystem::path& path, SensorSize sensor, Form form);

  void write(const EventPacket& packet) override;

 private:
  char separator_;
};

}  // namespace puck
