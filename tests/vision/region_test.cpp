#include "common/vision/geometry/region.h"

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("the intersection of regions is their common part") {
  const Region a{10, 20, 30, 40};
  CHECK(a.intersect({0, 0, 15, 25}) == Region{10, 20, 5, 5});
  CHECK(a.intersect({35, 50, 100, 100}) == Region{35, 50, 5, 10});
  CHECK(a.intersect({40, 20, 5, 5}).empty());
}

TEST_CASE("a region around a pixel has that pixel in its middle") {
  CHECK(Region::around({100, 50}, 7, 5) == Region{97, 48, 7, 5});
  CHECK(Region::around({100, 50}, 7, 5).centre() == Pixel{100, 50});
  CHECK(Region::around({100.4, 49.6}, 7, 5) == Region{97, 48, 7, 5});
}

TEST_CASE("inflating a region adds the margin on every side") {
  CHECK(Region{10, 20, 3, 4}.inflated(2) == Region{8, 18, 7, 8});
}

}  // namespace puck
