#include "common/vision/refuted_places.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

TEST_CASE("A refuted place is known for a tenth of a second, 6 px around") {
  RefutedPlaces places;
  CHECK_FALSE(places.contains({0, 0}, 0));
  places.add({100, 50}, 1'000);
  CHECK(places.contains({105.9, 44.1}, 1'000));
  CHECK_FALSE(places.contains({106, 50}, 1'000));
  CHECK_FALSE(places.contains({100, 56}, 1'000));
  CHECK(places.contains({100, 50}, 100'999));
  CHECK_FALSE(places.contains({100, 50}, 101'000));
}

TEST_CASE("The latest 32 places are remembered") {
  RefutedPlaces places;
  for (int i = 0; i < 33; ++i) places.add({20.0 * i, 0}, 0);
  CHECK_FALSE(places.contains({0, 0}, 0));
  CHECK(places.contains({20, 0}, 0));
  CHECK(places.contains({640, 0}, 0));
}

}  // namespace
}  // namespace puck
