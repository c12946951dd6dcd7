#include "services/launch/service_log.h"

#include <array>
#include <string>
#include <thread>

#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include "tests/support/stuck_pipe.h"

namespace puck {
namespace {

// All output of a pipe until its writers have closed it.
std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> piece{};
  for (;;) {
    const ssize_t count = read(descriptor, piece.data(), piece.size());
    if (count <= 0) return text;
    text.append(piece.data(), static_cast<std::size_t>(count));
  }
}

struct Pipe {
  Pipe() { REQUIRE(pipe2(ends.data(), O_CLOEXEC) == 0); }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  void close_end(std::size_t end) {
    if (ends[end] >= 0) close(ends[end]);
    ends[end] = -1;
  }

  std::array<int, 2> ends{-1, -1};
};

}  // namespace

TEST_CASE("A log is written whole and in order before it ends") {
  Pipe pipe;
  std::string text;
  std::jthread reader([&] { text = read_all(pipe.ends[0]); });
  {
    ServiceLog log("test", pipe.ends[1]);
    log.logger().set_pattern("%v");
    for (int i = 0; i < 1000; ++i) log.logger().info("line {}", i);
    CHECK(log.lost_lines() == 0);
  }
  pipe.close_end(1);
  reader.join();
  std::string expected;
  for (int i = 0; i < 1000; ++i) expected += "line " + std::to_string(i) + "\n";
  CHECK(text == expected);
}

TEST_CASE("An unread log delays no service, counts its lost lines, and ends") {
  const StuckPipe pipe;
  ServiceLog log("test", pipe.descriptor());
  // Waiting for the reader would block for ever.
  for (int i = 0; i < 5000; ++i) log.logger().info("line {}", i);
  // The writer may hold one line already.
  CHECK(log.lost_lines() >= 5000 - LineWriter::kMostLines - 1);
  CHECK(log.lost_lines() <= 5000 - LineWriter::kMostLines);
}

TEST_CASE("A log with a closed reader ends no service") {
  Pipe pipe;
  ServiceLog log("test", pipe.ends[1]);
  pipe.close_end(0);
  for (int i = 0; i < 10; ++i) log.logger().info("line {}", i);
  CHECK(log.lost_lines() == 0);
}

TEST_CASE("A log line gives time, name and level, without colours in a file") {
  Pipe pipe;
  {
    ServiceLog log("puck-test", pipe.ends[1]);
    log.logger().warn("look out");
  }
  pipe.close_end(1);
  const std::string text = read_all(pipe.ends[0]);
  CHECK(text.size() == std::string("12:34:56.789 puck-test warning: look out\n").size());
  CHECK(text.ends_with(" puck-test warning: look out\n"));
}

}  // namespace puck
