#include "common/io/temporary_path.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include <unistd.h>

#include "common/io/event_reader.h"
#include "common/posix/file_descriptor.h"

namespace puck {

TemporaryPath::TemporaryPath(std::string_view prefix) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  std::string name = (folder / (std::string(prefix) + "XXXXXX")).string();
  const FileDescriptor file(mkstemp(name.data()));
  if (!file.is_open()) {
    throw EventFileError(name + ": a temporary file cannot be made: " + std::strerror(errno) +
                         "; set TMPDIR to a folder that can be written");
  }
  path_ = name;
}

TemporaryPath::~TemporaryPath() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace puck
