#include "common/io/output_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "common/io/event_reader.h"

namespace puck {

OutputFile::OutputFile(const std::filesystem::path& path)
    : name_(path == "-" ? "stdout" : path.string()),
      file_(path == "-" ? dup(STDOUT_FILENO)
                        : open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (!file_.is_open()) {
    throw EventFileError(name_ + ": cannot be opened for writing: " + std::strerror(errno));
  }
}

void OutputFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t count = ::write(file_.number(), rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      buffer_.clear();
      throw EventFileError(name_ + ": cannot be written: " + std::strerror(errno));
    }
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  buffer_.clear();
}

void copy_to_stdout(const std::filesystem::path& path) {
  OutputFile out("-");
  std::ifstream in(path, std::ios::binary);
  std::vector<char> block(65536);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    out.append({block.data(), static_cast<std::size_t>(in.gcount())});
  }
  out.flush();
}

}  // namespace puck
