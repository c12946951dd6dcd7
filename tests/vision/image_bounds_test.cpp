#include "common/vision/geometry/image_bounds.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr SensorSize kSmallSensor{320, 240};

TEST_CASE("the image ends at the centres of its last pixels") {
  for (const Pixel inside : {Pixel{0, 0}, Pixel{319, 239}})
    CHECK(is_in_image(inside, kSmallSensor));
  for (const Pixel outside : {Pixel{-0.1, 9}, Pixel{9, -0.1}, Pixel{319.1, 9}, Pixel{9, 239.1}}) {
    CHECK_FALSE(is_in_image(outside, kSmallSensor));
  }
}

TEST_CASE("the nearest place of one outside is on a border or corner") {
  CHECK(nearest_in_image({100, 50}, kSmallSensor) == Pixel{100, 50});
  CHECK(nearest_in_image({-20, 50}, kSmallSensor) == Pixel{0, 50});
  CHECK(nearest_in_image({400, 300}, kSmallSensor) == Pixel{319, 239});
}

}  // namespace
}  // namespace puck
