#include "common/io/file_bytes.h"

#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/io/event_reader.h"
#include "common/posix/file_descriptor.h"

namespace puck {
namespace {

class FileBytes final : public ByteSource {
 public:
  FileBytes(const std::string& path, const Interruption* interruption)
      : interruption_(interruption),
        name_(path == "-" ? "stdin" : path),
        file_(path == "-" ? dup(STDIN_FILENO) : open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (!file_.is_open()) {
      throw EventFileError(name_ + ": cannot be opened: " + std::strerror(errno));
    }
    start_ = lseek(file_.number(), 0, SEEK_CUR);
  }

  const std::string& name() const override { return name_; }

  std::size_t read(std::span<std::byte> bytes) override {
    std::size_t filled = 0;
    while (filled < bytes.size()) {
      if (start_ < 0 && interruption_ != nullptr) wait();
      const ssize_t count = ::read(file_.number(), bytes.data() + filled, bytes.size() - filled);
      if (count == 0) break;
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) {
        throw EventFileError(name_ + ": cannot be read to its end: " + std::strerror(errno));
      }
      filled += static_cast<std::size_t>(count);
    }
    return filled;
  }

  std::optional<double> share_read() const override {
    struct stat status {};
    if (start_ < 0 || fstat(file_.number(), &status) != 0 || status.st_size <= 0) {
      return std::nullopt;
    }
    const off_t place = lseek(file_.number(), 0, SEEK_CUR);
    return static_cast<double>(place) / static_cast<double>(status.st_size);
  }

  bool can_rewind() const override { return start_ >= 0; }

  void rewind() override {
    if (!can_rewind()) {
      throw EventFileError(name_ +
                           ": can be read only once, because it is a pipe; expected a file");
    }
    if (lseek(file_.number(), start_, SEEK_SET) < 0) {
      throw EventFileError(name_ + ": cannot be read again: " + std::strerror(errno));
    }
  }

 private:
  // For bytes, or the end. Throws when it is interrupted.
  void wait() const {
    std::array<pollfd, 2> descriptors{
        {{file_.number(), POLLIN, 0}, {interruption_->number(), POLLIN, 0}}};
    while (poll(descriptors.data(), descriptors.size(), -1) < 0 && errno == EINTR) {
    }
    if (descriptors[1].revents != 0) throw EventFileError(name_ + ": reading was interrupted");
  }

  const Interruption* interruption_;
  std::string name_;
  FileDescriptor file_;
  off_t start_ = -1;  // Below 0: a pipe.
};

}  // namespace

std::unique_ptr<ByteSource> open_file_bytes(const std::string& path,
                                            const Interruption* interruption) {
  return std::make_unique<FileBytes>(path, interruption);
}

}  // namespace puck
