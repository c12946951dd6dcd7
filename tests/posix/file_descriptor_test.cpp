#include "common/posix/file_descriptor.h"

#include <utility>

#include <doctest/doctest.h>
#include <fcntl.h>

namespace puck {
namespace {

FileDescriptor opened() { return FileDescriptor(open("/dev/null", O_RDONLY | O_CLOEXEC)); }

bool is_open(int number) { return fcntl(number, F_GETFD) >= 0; }

}  // namespace

TEST_CASE("a descriptor is closed at its end, and when another one replaces it") {
  int first = -1;
  int second = -1;
  {
    FileDescriptor descriptor = opened();
    first = descriptor.number();
    CHECK(is_open(first));
    descriptor = opened();
    second = descriptor.number();
    CHECK(second != first);
    CHECK_FALSE(is_open(first));
    CHECK(is_open(second));
  }
  CHECK_FALSE(is_open(second));
}

TEST_CASE("a moved descriptor has one owner only") {
  FileDescriptor descriptor = opened();
  const int number = descriptor.number();
  {
    FileDescriptor owner(std::move(descriptor));
    CHECK(owner.number() == number);
    CHECK_FALSE(descriptor.is_open());
    FileDescriptor& itself = owner;
    owner = std::move(itself);
    CHECK(is_open(number));
    descriptor = std::move(owner);
  }
  CHECK(descriptor.number() == number);
  CHECK(is_open(number));
  descriptor = {};
  CHECK_FALSE(is_open(number));
}

TEST_CASE("a failed open gives no descriptor") {
  const FileDescriptor missing(open("/nowhere/at/all", O_RDONLY | O_CLOEXEC));
  CHECK_FALSE(missing.is_open());
  CHECK_FALSE(FileDescriptor().is_open());
}

}  // namespace puck
