#include <cmath>

#include <doctest/doctest.h>

#include "common/vision/blob_witness.h"
#include "common/vision/event_history.h"

namespace puck {
namespace {

TEST_CASE("A pixel's event is the first of its sign only after 3 ms of silence") {
  EventHistory history({4, 3});
  const Event on{2, 1, 1, 0};
  const Event off{2, 1, 0, 0};
  CHECK(history.is_first(on, 10'000));
  CHECK_FALSE(history.is_first(on, 12'000));
  CHECK(history.is_first(off, 12'500));
  CHECK_FALSE(history.is_first(on, 15'000));
  CHECK(history.is_first(on, 18'001));
  CHECK(history.is_first({3, 1, 1, 0}, 18'001));
}

TEST_CASE("The blob follows events within two semi-axes and ignores the others") {
  BlobWitness blob({100, 100});
  blob.set_size({30, 20});
  blob.take(131, 100);
  blob.take(100, 121);
  CHECK(blob.position() == Pixel{100, 100});
  blob.take(120, 100);
  CHECK(blob.position().x == doctest::Approx(100.3));
}

TEST_CASE("The blob can be drawn a share of the way to a place") {
  BlobWitness blob({100, 100});
  blob.draw_to({110, 80}, 0.1);
  CHECK(blob.position().x == doctest::Approx(101));
  CHECK(blob.position().y == doctest::Approx(98));
}

TEST_CASE("The blob keeps up with a shot of 6 px a millisecond, and knows its speed") {
  BlobWitness blob({50, 100});
  blob.set_size({36, 28});
  double x = 50;
  for (int step = 0; step < 200; ++step) {
    x += 3;
    for (int i = 0; i < 90; ++i) {
      const double angle = 0.07 * i;
      blob.take(x + 18 * std::cos(angle), 100 + 14 * std::sin(angle));
    }
    blob.note();
  }
  CHECK(std::abs(blob.position().x - x) < 9);
  CHECK(blob.velocity().x == doctest::Approx(6000).epsilon(0.1));
}

}  // namespace
}  // namespace puck
