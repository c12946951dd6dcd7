// Common behaviour of all baselines.

#include <memory>

#include <doctest/doctest.h>

#include "common/baselines/cluster_tracker.h"
#include "common/baselines/particle_filter.h"
#include "common/baselines/particle_filter_eros.h"
#include "tests/baselines/ring_scene.h"

namespace puck {
namespace {

using test::kSensor;
using test::kSizeModel;
using test::RingScene;

std::unique_ptr<TrackingAlgorithm> make_baseline(int which, std::uint64_t seed = 1) {
  if (which == 0) {
    return std::make_unique<ClusterTracker>(kSensor, puck_cluster_params(), kSizeModel);
  }
  if (which == 1) {
    ParticleFilterParams params;
    params.set.seed = seed;
    return std::make_unique<ParticleFilter>(kSensor, params, kSizeModel);
  }
  ParticleFilterErosParams params;
  params.set.seed = seed;
  return std::make_unique<ParticleFilterEros>(kSensor, params, kSizeModel);
}

constexpr int kBaselines = 3;

Pixel truth_at(int ms) { return {300 + 0.7 * ms, 190 + 0.2 * ms}; }

}  // namespace

TEST_CASE("the same events give the same baseline estimates to the bit") {
  for (int which = 0; which < kBaselines; ++which) {
    CAPTURE(which);
    const auto first = make_baseline(which);
    const auto second = make_baseline(which);
    RingScene first_scene(*first);
    RingScene second_scene(*second);
    for (int ms = 0; ms < 100; ++ms) {
      const PuckEstimate a = first_scene.show(truth_at(ms));
      const PuckEstimate b = second_scene.show(truth_at(ms));
      REQUIRE(a.state == b.state);
      REQUIRE(a.position == b.position);
      REQUIRE(a.size.width == b.size.width);
      REQUIRE(a.score == b.score);
    }
  }
}

TEST_CASE("another seed gives another track of the particle filters") {
  for (int which = 1; which < kBaselines; ++which) {
    CAPTURE(which);
    const auto first = make_baseline(which, 1);
    const auto second = make_baseline(which, 2);
    RingScene first_scene(*first);
    RingScene second_scene(*second);
    PuckEstimate a;
    PuckEstimate b;
    for (int ms = 0; ms < 50; ++ms) {
      a = first_scene.show(truth_at(ms));
      b = second_scene.show(truth_at(ms));
    }
    REQUIRE(a.position.has_value());
    CHECK_FALSE(a.position == b.position);
  }
}

TEST_CASE("no baseline starts again when the puck appears elsewhere") {
  for (int which = 0; which < kBaselines; ++which) {
    CAPTURE(which);
    const auto baseline = make_baseline(which);
    RingScene scene(*baseline);
    scene.show_until_detected({200, 190});
    PuckEstimate estimate;
    for (int ms = 0; ms < 30; ++ms) estimate = scene.show({450, 190});
    CHECK(estimate.state == TrackState::kTracking);
    CHECK(test::distance_px(estimate, {450, 190}) > 100);
  }
}

TEST_CASE("an empty packet changes nothing") {
  for (int which = 0; which < kBaselines; ++which) {
    CAPTURE(which);
    const auto baseline = make_baseline(which);
    baseline->update(EventPacket{{5}, {}});
    CHECK(baseline->estimate().state == TrackState::kSearching);
    RingScene scene(*baseline);
    const PuckEstimate seed = scene.show_until_detected({300, 190});
    baseline->update(EventPacket{{1'000'000}, {}});
    const PuckEstimate after = baseline->estimate();
    CHECK(after.position == seed.position);
    CHECK(after.newest_event == seed.newest_event);
    CHECK(after.score == seed.score);
  }
}

}  // namespace puck
