#include "common/vision/recent_pixels.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

TEST_CASE("A pixel counts as repeated until four others have fired") {
  RecentPixels pixels;
  CHECK_FALSE(pixels.repeats(0, 0));
  CHECK_FALSE(pixels.repeats(10, 20));
  CHECK(pixels.repeats(10, 20));
  CHECK(pixels.repeats(0, 0));
  for (const int x : {11, 12, 13}) CHECK_FALSE(pixels.repeats(x, 20));
  CHECK(pixels.repeats(10, 20));
  CHECK_FALSE(pixels.repeats(14, 20));
  CHECK_FALSE(pixels.repeats(10, 20));
}

}  // namespace
}  // namespace puck
