#include "services/logger/log_thread.h"

#include <latch>
#include <vector>

#include <doctest/doctest.h>

#include "common/messaging/log_format.h"

namespace puck {
namespace {

/// The times of the records.
std::vector<std::int64_t> times_of(std::span<const std::uint8_t> records) {
  std::vector<std::int64_t> times;
  while (!records.empty()) {
    const auto header = parse_log_header(records);
    times.push_back(header.value().utime);
    records = records.subspan(header->record_bytes());
  }
  return times;
}

}  // namespace

TEST_CASE("while the disk blocks the bus continues, and queued messages are written in the end") {
  std::latch disk_moves(1);
  std::vector<std::int64_t> written;
  LogThread thread(100'000, [&](std::span<std::uint8_t> records) {
    disk_moves.wait();
    const auto times = times_of(records);
    written.insert(written.end(), times.begin(), times.end());
    return records.size();
  });
  const std::vector<std::uint8_t> message(1000);
  std::vector<std::int64_t> accepted;
  // A wait for the disk would block the test here.
  for (int i = 0; i < 1000; ++i) {
    if (thread.push("PUCK_EVENTS", i, message)) accepted.push_back(i);
  }
  CHECK(accepted.size() == 96);  // Of 1039 bytes each.
  CHECK(thread.queue().most_bytes() <= 100'000);
  disk_moves.count_down();
  thread.finish();
  CHECK(written == accepted);
}

TEST_CASE("messages written one by one are passed on one by one") {
  std::vector<std::int64_t> written;
  LogThread thread(100'000, [&](std::span<std::uint8_t> records) {
    written.push_back(times_of(records).front());
    return parse_log_header(records).value().record_bytes();
  });
  for (int i = 0; i < 50; ++i) REQUIRE(thread.push("A", i, {}));
  thread.finish();
  REQUIRE(written.size() == 50);
  for (int i = 0; i < 50; ++i) CHECK(written[static_cast<std::size_t>(i)] == i);
}

}  // namespace puck
