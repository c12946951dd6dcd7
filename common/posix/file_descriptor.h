#pragma once

#include <utility>

#include <unistd.h>

namespace puck {

/// Sole owner of a file descriptor of any kind. Closes it on destruction and on assignment.
/// Movable.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  /// `number`: as returned by open(), socket() and similar calls; below 0 on failure.
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() {
    if (is_open()) close(number_);
  }
  FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    FileDescriptor taken(std::move(other));
    std::swap(number_, taken.number_);
    return *this;
  }

  bool is_open() const { return number_ >= 0; }
  /// Below 0: no descriptor is open.
  int number() const { return number_; }

 private:
  int number_ = -1;
};

}  // namespace puck
