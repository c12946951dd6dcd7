#include "common/yarp/newest_value.h"

#include <cstdint>
#include <thread>

#include <doctest/doctest.h>

namespace puck {
namespace {

struct Pair {
  std::int64_t one = 0;
  std::int64_t other = 0;
};

}  // namespace

TEST_CASE("a writer that blocks in the middle of a value does not block the reader") {
  NewestValue<Pair> value;
  value.next() = {1, 1};
  CHECK(!value.publish());
  value.next() = {2, 0};
  CHECK(value.look());
  CHECK(value.seen().one == 1);
  CHECK(!value.look());
  CHECK(value.seen().other == 1);
}

TEST_CASE("a reader that blocks does not block the writer, and gets the newest value afterwards") {
  NewestValue<Pair> value;
  value.next() = {1, 1};
  value.publish();
  REQUIRE(value.look());
  const Pair& held = value.seen();
  for (std::int64_t i = 2; i <= 100; ++i) {
    value.next() = {i, i};
    CHECK(value.publish() == (i > 2));
    REQUIRE(held.one == 1);
  }
  CHECK(value.look());
  CHECK(value.seen().one == 100);
}

TEST_CASE("between two threads no value is torn or out of order") {
  constexpr std::int64_t kValues = 200'000;
  NewestValue<Pair> value;
  const std::jthread writer([&] {
    for (std::int64_t i = 1; i <= kValues; ++i) {
      value.next() = {i, -i};
      value.publish();
    }
  });
  std::int64_t before = 0;
  std::int64_t torn = 0;
  std::int64_t backwards = 0;
  while (before < kValues) {
    if (!value.look()) {
      std::this_thread::yield();
      continue;
    }
    const Pair seen = value.seen();
    if (seen.one != -seen.other) ++torn;
    if (seen.one <= before) ++backwards;
    before = seen.one;
  }
  CHECK(torn == 0);
  CHECK(backwards == 0);
}

}  // namespace puck
