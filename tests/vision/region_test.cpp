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

TEST_CASE(
    "the union of two regions is the smallest that holds both, and an empty one adds nothing") {
  const Region a{2, 3, 10, 5};
  CHECK(a.united({20, 1, 2, 3}) == Region{2, 1, 20, 7});
  CHECK(a.united({4, 4, 1, 1}) == a);
  CHECK(a.united({50, 50, 0, 3}) == a);
  CHECK(Region{9, 9, 0, 0}.united(a) == a);
}

}  // namespace puck
