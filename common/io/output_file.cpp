#include "common/io/output_file.h"

#include <cerrno>
#include <cstring>

#include "common/io/event_reader.h"

namespace puck {

OutputFile::OutputFile(const std::filesystem::path& path) : name_(path.string()) {
  errno = 0;
  file_.open(path, std::ios::binary | std::ios::trunc);
  if (!file_) {
    throw EventFileError(name_ + ": cannot be opened for writing: " + std::strerror(errno));
  }
}

void OutputFile::flush() {
  errno = 0;
  file_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  file_.flush();
  buffer_.clear();
  if (!file_) throw EventFileError(name_ + ": cannot be written: " + std::strerror(errno));
}

}  // namespace puck
