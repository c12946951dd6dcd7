#include "common/runtime/event_queue.h"

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

namespace puck {
namespace {

// `count` events, a microsecond apart, with their number in x.
std::vector<Event> numbered(int first, int count) {
  std::vector<Event> events;
  for (int i = 0; i < count; ++i) {
    events.push_back({static_cast<std::uint16_t>((first + i) % 100), 0, 0,
                      static_cast<std::uint32_t>(first + i)});
  }
  return events;
}

// The times of all events in the queue, µs.
std::vector<std::int64_t> pop_all(EventQueue& queue) {
  std::vector<std::int64_t> times;
  std::vector<Event> events;
  while (true) {
    const Timestamp start = queue.pop(queue.end(), 7, events);
    if (events.empty()) return times;
    for (const Event& event : events) times.push_back(start.us + event.offset_us);
  }
}

}  // namespace

TEST_CASE("events come out in order with their times") {
  EventQueue queue(100);
  const std::vector<Event> events{{10, 10, 1, 0}, {9, 10, 1, 3}, {19, 19, 0, 5}};
  queue.push({5'000'000'000}, events);
  std::vector<Event> out;
  CHECK(queue.pop(queue.end(), 100, out) == Timestamp{5'000'000'000});
  CHECK(out == events);
  CHECK(queue.thinned() == 0);
}

TEST_CASE("at most the requested number of events is taken, and none beyond a position") {
  EventQueue queue(100);
  queue.push({0}, numbered(0, 10));
  const std::uint64_t until = queue.end();
  queue.push({0}, numbered(10, 10));
  std::vector<Event> out;
  CHECK(queue.pop(until, 6, out) == Timestamp{0});
  CHECK(out.size() == 6);
  CHECK(queue.pop(until, 6, out) == Timestamp{6});
  CHECK(out.size() == 4);
  queue.pop(until, 6, out);
  CHECK(out.empty());
  CHECK(pop_all(queue).front() == 10);
}

TEST_CASE("a pause too long for an event's offset ends a batch, and loses nothing") {
  EventQueue queue(10);
  queue.push({0}, numbered(0, 1));
  queue.push({10'000'000'000}, numbered(0, 1));
  std::vector<Event> out;
  CHECK(queue.pop(queue.end(), 10, out) == Timestamp{0});
  CHECK(out.size() == 1);
  CHECK(queue.pop(queue.end(), 10, out) == Timestamp{10'000'000'000});
  CHECK(out.size() == 1);
}

TEST_CASE("an unread queue takes half of its capacity whole and thins the rest evenly") {
  EventQueue queue(64);
  queue.push({0}, numbered(0, 1000));
  const std::vector<std::int64_t> times = pop_all(queue);
  REQUIRE(times.size() == 64);
  CHECK(queue.thinned() == 1000 - 64);
  for (std::size_t i = 1; i < times.size(); ++i) {
    const std::int64_t gap = times[i] - times[i - 1];
    // Gaps of 1 in the first half, of 2 in the next quarter, of 4 in the eighth after that …
    const std::int64_t expected = i < 32 ? 1 : i < 48 ? 2 : i < 56 ? 4 : i < 60 ? 8 : 0;
    CAPTURE(i);
    if (expected > 0) CHECK(gap == expected);
  }
  CHECK(std::is_sorted(times.begin(), times.end()));
  queue.push({2000}, numbered(0, 30));
  CHECK(pop_all(queue).size() == 30);  // whole again once there is room
}

TEST_CASE("between two threads events pass in order, and lost ones are counted") {
  EventQueue queue(256);
  constexpr int kEvents = 200'000;
  std::jthread producer([&] {
    for (int i = 0; i < kEvents; i += 50) queue.push({0}, numbered(i, 50));
  });
  std::int64_t taken = 0;
  std::int64_t newest = -1;
  std::vector<Event> out;
  while (taken + queue.thinned() < kEvents) {
    const Timestamp start = queue.pop(queue.end(), 100, out);
    for (const Event& event : out) {
      const std::int64_t time = start.us + event.offset_us;
      REQUIRE(time > newest);
      REQUIRE(event.x == time % 100);
      newest = time;
    }
    taken += static_cast<std::int64_t>(out.size());
  }
  CHECK(taken + queue.thinned() == kEvents);
  CHECK(taken > 0);
}

TEST_CASE("a queue without capacity is refused") {
  CHECK_THROWS_WITH_AS(EventQueue(1), "an event queue needs room for at least 2 events, got 1",
                       std::invalid_argument);
}

}  // namespace puck
