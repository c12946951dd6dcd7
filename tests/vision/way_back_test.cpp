#include "common/vision/way_back.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

TEST_CASE("where a puck that left may be grows by 1.3 px a millisecond") {
  WayBack way_back;
  CHECK_FALSE(way_back.reach(0));
  way_back.note_left({-15, 100}, 5'000);
  REQUIRE(way_back.reach(5'000));
  CHECK(way_back.reach(5'000)->from == Pixel{-15, 100});
  CHECK(way_back.reach(5'000)->contains({45, 100}));
  CHECK_FALSE(way_back.reach(5'000)->contains({45.01, 100}));
  CHECK(way_back.reach(105'000)->contains({174.99, 100}));
  CHECK_FALSE(way_back.reach(105'000)->contains({175.01, 100}));
}

TEST_CASE("it is within reach up to that distance, whatever the direction") {
  const WayBack::Reach reach{{0, 100}};
  CHECK(reach.contains({36, 148}));
  CHECK_FALSE(reach.contains({37, 148}));
}

TEST_CASE("it may have come farther at its speed, or at twice that") {
  WayBack way_back;
  way_back.note_left({-15, 100}, 5'000);
  const auto reach = way_back.reach(25'000);
  REQUIRE(reach);
  CHECK(reach->gone_s == doctest::Approx(0.02));
  // 60 px, and 20 ms at 2 x 1,500 px/s.
  CHECK(reach->may_lead_to({104, 100}, 1'500));
  CHECK_FALSE(reach->may_lead_to({106, 100}, 1'500));
  CHECK(reach->may_lead_to({106, 100}, 1'550));
}

TEST_CASE("once it is back that is forgotten") {
  WayBack way_back;
  way_back.note_left({-15, 100}, 0);
  way_back.forget();
  CHECK_FALSE(way_back.reach(1'000));
}

}  // namespace
}  // namespace puck
