#pragma once

#include <utility>

#include <unistd.h>

namespace puck {

/// A file descriptor that nobody else owns: a file's, a socket's or any other. It is closed in the
/// end, and when another one is assigned. Moves.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  /// `number`: as open(), socket() and their like return it; below 0 where they failed.
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
  /// Below 0: none is open.
  int number() const { return number_; }

 private:
  int number_ = -1;
};

}  // namespace puck
