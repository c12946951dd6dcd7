#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/io/event_writer.h"
#include "common/io/output_file.h"

namespace puck {

/// A writer whose file is written from its beginning to its end.
class FileEventWriter : public EventWriter {
 public:
  ~FileEventWriter() override;

  void close() override { file_.flush(); }

 protected:
  /// Throws EventFileError, std::invalid_argument for an invalid sensor.
  FileEventWriter(const std::filesystem::path& path, SensorSize sensor);

  /// The header of Prophesee RAW: `version` as "3.0", `format` as "EVT3", `more` behind the size.
  void write_raw_header(const std::string& version, const std::string& format,
                        std::string_view more = "");

  SensorSize sensor_;
  OutputFile file_;
  Timestamp newest_{0};
};

}  // namespace puck
