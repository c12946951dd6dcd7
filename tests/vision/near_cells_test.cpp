#include "common/vision/hypotheses/near_cells.h"

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("cells hold all of the regions added since they were cleared, and little else") {
  constexpr SensorSize kSensor{101, 75};
  NearCells cells(kSensor);
  cells.add({1, 1, 3, 3});
  cells.clear();
  const Region added[]{{20, 30, 25, 9}, {-5, 60, 12, 40}, {95, -3, 50, 10}, {300, 300, 5, 5}};
  for (const Region& region : added) cells.add(region);
  for (int y = 0; y < kSensor.height; ++y) {
    for (int x = 0; x < kSensor.width; ++x) {
      bool inside = false;
      bool near = false;
      for (const Region& region : added) {
        inside = inside || region.contains(x, y);
        near = near || region.inflated(7).contains(x, y);
      }
      CAPTURE(x);
      CAPTURE(y);
      if (inside) REQUIRE(cells.contains(x, y));
      if (!near) REQUIRE_FALSE(cells.contains(x, y));
    }
  }
}

}  // namespace puck
