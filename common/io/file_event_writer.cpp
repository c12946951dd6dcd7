#include "common/io/file_event_writer.h"

#include <exception>

#include "common/io/event_checks.h"

namespace puck {

FileEventWriter::FileEventWriter(const std::filesystem::path& path, SensorSize sensor)
    : sensor_(checked_sensor(sensor)), file_(path) {}

FileEventWriter::~FileEventWriter() {
  try {
    file_.flush();
  } catch (const std::exception&) {
    // A caller that needs the error calls close() first.
  }
}

void FileEventWriter::write_raw_header(const std::string& version, const std::string& format,
                                       std::string_view more) {
  const std::string width = std::to_string(sensor_.width);
  const std::string height = std::to_string(sensor_.height);
  file_.append("% evt " + version + "\n% format " + format + ";height=" + height +
               ";width=" + width);
  file_.append(more);
  file_.append("\n% geometry " + width + "x" + height + "\n% end\n");
}

}  // namespace puck
