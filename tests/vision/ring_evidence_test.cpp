#include "common/vision/ring_evidence.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr RingAreas kAreas{200, 300, 600};
constexpr RingAreas kPrintedAreas{200, 300, 600, true};

RingEvidence whole_ring(int events_per_sector) {
  RingEvidence evidence;
  for (int i = 0; i < events_per_sector; ++i) {
    for (int sector = 0; sector < kContourSectors; ++sector) evidence.add_ring(sector, true);
  }
  return evidence;
}

TEST_CASE("A ring with nothing around it is of nearly perfect quality") {
  const RingEvidence evidence = whole_ring(20);
  CHECK(evidence.cover(kAreas) == doctest::Approx(1));
  CHECK(evidence.quality(kAreas) > 0.95);
  CHECK(evidence.strength(kAreas) == doctest::Approx(240));
}

TEST_CASE("Events as dense everywhere as on the ring are no evidence") {
  RingEvidence evidence = whole_ring(20);
  for (int i = 0; i < 360; ++i) evidence.add_inside(kAreas);
  for (int i = 0; i < 720; ++i) evidence.add_outside(kAreas);
  CHECK(evidence.quality(kAreas) == doctest::Approx(0).epsilon(0.01));
  CHECK(evidence.strength(kAreas) == doctest::Approx(0).epsilon(0.01));
}

TEST_CASE("An edge that touches the ring in one direction is of poor quality") {
  RingEvidence evidence;
  for (int i = 0; i < 200; ++i) evidence.add_ring(4, true);
  CHECK(evidence.quality(kAreas) < 0.3);
}

TEST_CASE("A ring that is cut off by the image's border covers all that can be seen of it") {
  RingEvidence half;
  for (int sector = 0; sector < kContourSectors / 2; ++sector) {
    for (int i = 0; i < 20; ++i) half.add_ring(sector, true);
  }
  CHECK(half.cover(kAreas) == doctest::Approx(0.5));
  RingAreas cut = kAreas;
  cut.sectors = kContourSectors / 2;
  CHECK(half.cover(cut) == doctest::Approx(1));
  // Where more is seen than lies in the image, there is no more to cover.
  CHECK(whole_ring(20).cover(cut) == 1);
}

TEST_CASE("Events of the wrong sign count against the ring") {
  RingEvidence evidence = whole_ring(10);
  const double before = evidence.quality(kAreas);
  for (int i = 0; i < 60; ++i) evidence.add_wrong_sign();
  CHECK(evidence.quality(kAreas) < before - 0.4);
}

TEST_CASE(
    "Noise says nothing for a ring nor against it, but more of it leaves less to be sure of") {
  // 0.05 events a px² everywhere, and as many again on the ring.
  RingEvidence evidence = whole_ring(2);
  for (int i = 0; i < 15; ++i) evidence.add_inside(kAreas);
  for (int i = 0; i < 30; ++i) evidence.add_outside(kAreas);
  CHECK(evidence.quality(kAreas) < 0.4);
  CHECK(evidence.quality(kAreas, 0.05) == doctest::Approx(0.07 / (0.07 + 0.02 + 0.05)));
  // Where signs are judged, half of the noise on the ring has the wrong one.
  RingEvidence judged = whole_ring(1);
  for (int i = 0; i < 5; ++i) judged.add_wrong_sign();
  CHECK(judged.quality(kAreas, 0.05) == doctest::Approx(0.035 / (0.035 + 0.02 + 0.05)));
  // More than there is: nothing is left, and not less than that.
  CHECK(evidence.quality(kAreas, 0.5) == 0);
}

TEST_CASE("Evidence fades") {
  RingEvidence evidence = whole_ring(10);
  evidence.fade(0.25);
  CHECK(evidence.ring_events() == doctest::Approx(30));
}

}  // namespace
}  // namespace puck
