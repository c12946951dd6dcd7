#include "common/vision/refuted_places.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

TEST_CASE("A refuted place is known for a tenth of a second, 6 px around") {
  RefutedPlaces places;
  CHECK_FALSE(places.contains({0, 0}, 0.5, 0));
  places.add({100, 50}, 0.5, 1'000);
  CHECK(places.contains({105.9, 44.1}, 0.5, 1'000));
  CHECK_FALSE(places.contains({106, 50}, 0.5, 1'000));
  CHECK_FALSE(places.contains({100, 56}, 0.5, 1'000));
  CHECK(places.contains({100, 50}, 0.5, 100'999));
  CHECK_FALSE(places.contains({100, 50}, 0.5, 101'000));
}

TEST_CASE("What looks clearly more like a puck than what was refuted there is tried") {
  RefutedPlaces places;
  places.add({100, 50}, 0.5, 0);
  CHECK(places.contains({100, 50}, 0.59, 0));
  CHECK_FALSE(places.contains({100, 50}, 0.61, 0));
}

TEST_CASE("The latest 32 places are remembered") {
  RefutedPlaces places;
  for (int i = 0; i < 33; ++i) places.add({20.0 * i, 0}, 0.5, 0);
  CHECK_FALSE(places.contains({0, 0}, 0.5, 0));
  CHECK(places.contains({20, 0}, 0.5, 0));
  CHECK(places.contains({640, 0}, 0.5, 0));
}

}  // namespace
}  // namespace puck
