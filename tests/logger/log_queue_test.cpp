#include "services/logger/log_queue.h"

#include <algorithm>
#include <deque>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "common/messaging/log_format.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

std::vector<std::uint8_t> message(std::size_t bytes, int number) {
  return std::vector<std::uint8_t>(bytes, static_cast<std::uint8_t>(number));
}

/// Removes the oldest record and returns its time; -1 from an empty queue.
std::int64_t take(LogQueue& queue) {
  const auto records = queue.front();
  if (records.empty()) return -1;
  const auto header = parse_log_header(records);
  REQUIRE(header);
  REQUIRE(header->record_bytes() <= records.size());
  const auto content =
      records.subspan(kLogHeaderBytes + header->channel_bytes, header->message_bytes);
  const auto number = static_cast<std::uint8_t>(header->utime);
  REQUIRE(std::ranges::count(content, number) == static_cast<std::ptrdiff_t>(content.size()));
  queue.release(header->record_bytes());
  return header->utime;
}

constexpr std::size_t kOverhead = kLogHeaderBytes + 1;  // Of a message on channel A.

}  // namespace

TEST_CASE("pushed messages are popped in order, in the log's format") {
  LogQueue queue(1000);
  CHECK(queue.front().empty());
  REQUIRE(queue.push("A", 1, message(10, 1)));
  REQUIRE(queue.push("A", 2, message(0, 2)));
  CHECK(queue.bytes() == 2 * kOverhead + 10);
  CHECK(queue.front().size() == queue.bytes());
  CHECK(take(queue) == 1);
  CHECK(take(queue) == 2);
  CHECK(take(queue) == -1);
  CHECK(queue.bytes() == 0);
  CHECK(queue.most_bytes() == 2 * kOverhead + 10);
}

TEST_CASE("a message that does not fit is refused, and earlier ones stay") {
  LogQueue queue(10 * (kOverhead + 10));
  for (int i = 0; i < 10; ++i) REQUIRE(queue.push("A", i, message(10, i)));
  CHECK_FALSE(queue.push("A", 10, message(10, 10)));
  CHECK_FALSE(queue.push("A", 10, message(0, 10)));
  CHECK(take(queue) == 0);
  CHECK(queue.push("A", 10, message(10, 10)));
  CHECK_FALSE(queue.push("A", 11, message(0, 11)));
  for (int i = 1; i <= 10; ++i) CHECK(take(queue) == i);
  CHECK_FALSE(queue.push("A", 12, message(10 * (kOverhead + 10), 12)));
}

TEST_CASE("a queue behaves like a list in any sequence of calls, and never exceeds its capacity") {
  std::mt19937 random(3);
  LogQueue queue(2000);
  std::deque<std::int64_t> expected;
  std::int64_t next = 0;
  int refused = 0;
  for (int step = 0; step < 20'000; ++step) {
    if (random() % 2 == 0) {
      const std::size_t bytes = random() % 300;
      if (queue.push("A", next, message(bytes, static_cast<int>(next)))) {
        expected.push_back(next++);
      } else {
        ++refused;
      }
    } else if (expected.empty()) {
      REQUIRE(take(queue) == -1);
    } else {
      REQUIRE(take(queue) == expected.front());
      expected.pop_front();
    }
    REQUIRE(queue.bytes() <= 2000);
  }
  CHECK(refused > 0);
  CHECK(next > 5'000);
}

TEST_CASE("every message that is not refused passes between two threads") {
  LogQueue queue(1 << 14);
  constexpr int kMessages = 20'000;
  std::int64_t pushed = 0;
  std::jthread bus([&] {
    for (int i = 0; i < kMessages; ++i) {
      while (!queue.push("A", i, message(static_cast<std::size_t>(i % 97), i))) {
        std::this_thread::yield();
      }
      ++pushed;
    }
  });
  std::int64_t taken = 0;
  while (taken < kMessages) {
    queue.wait({}, milliseconds(100));
    for (std::int64_t time = take(queue); time >= 0; time = take(queue)) REQUIRE(time == taken++);
  }
  bus.join();
  CHECK(pushed == kMessages);
}

}  // namespace puck
