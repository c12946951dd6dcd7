#include "common/vision/silent_trust.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr TrackLooks kFew{.quality = 0.1, .agreement = 0.8, .strength = 2};

TEST_CASE("A track of few events may be the puck's, as long as they lie on its ring") {
  CHECK(is_silent_puck(kFew, 0));
  TrackLooks looks = kFew;
  looks.agreement = 0.5;
  CHECK_FALSE(is_silent_puck(looks, 0));
  looks = kFew;
  looks.growth_px = 0.8;
  REQUIRE(looks.is_oversized());
  CHECK_FALSE(is_silent_puck(looks, 0));
}

TEST_CASE("It is remembered for two seconds after it was last good") {
  CHECK(is_silent_puck(kFew, 1'999'999));
  CHECK_FALSE(is_silent_puck(kFew, 2'000'000));
}

}  // namespace
}  // namespace puck
