#include "common/vision/missed_events.h"

#include <cstdint>

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr Region kAll{0, 0, 640, 480};

TEST_CASE("What happens from a search's beginning until what it found has caught up is kept") {
  MissedEvents missed;
  missed.take({.time_us = 1}, 0);
  CHECK(missed.events().empty());
  CHECK_FALSE(missed.are_kept());
  missed.begin(kAll);
  CHECK(missed.are_kept());
  missed.take({.time_us = 2}, 0.5);
  missed.take({.time_us = 3}, -1);
  REQUIRE(missed.events().size() == 2);
  CHECK(missed.events()[0].event.time_us == 2);
  CHECK(missed.events()[1].main_worth == -1);
  missed.end();
  CHECK_FALSE(missed.are_kept());
  missed.take({.time_us = 4}, 0);
  CHECK(missed.events().empty());
}

TEST_CASE("What happens elsewhere than the search looks is not kept") {
  MissedEvents missed;
  missed.begin({100, 100, 50, 50});
  missed.take({.time_us = 1, .x = 99, .y = 120}, 0);
  missed.take({.time_us = 2, .x = 100, .y = 149}, 0);
  REQUIRE(missed.events().size() == 1);
  CHECK(missed.events()[0].event.time_us == 2);
}

TEST_CASE("Of too many events the first are kept") {
  MissedEvents missed;
  missed.begin(kAll);
  CHECK(missed.has_room());
  for (std::int64_t t = 1; t <= 10'000; ++t) missed.take({.time_us = t}, 0);
  REQUIRE(missed.events().size() == 8'192);
  CHECK(missed.events().back().event.time_us == 8'192);
  CHECK_FALSE(missed.has_room());
}

}  // namespace
}  // namespace puck
