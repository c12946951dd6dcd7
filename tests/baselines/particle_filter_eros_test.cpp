#include "common/baselines/particle_filter_eros.h"

#include <doctest/doctest.h>

#include "tests/baselines/refusal.h"
#include "tests/baselines/ring_scene.h"

namespace puck {
namespace {

using test::kSensor;
using test::kSizeModel;
using test::kStart;
using test::RingScene;

}  // namespace

TEST_CASE("a particle filter on the surface is seeded only once the puck has been detected") {
  ParticleFilterEros filter(kSensor, {}, kSizeModel);
  RingScene scene(filter);
  CHECK(scene.give({test::far_event()}).state == TrackState::kSearching);
  const PuckEstimate seed = scene.show_until_detected(kStart);
  CHECK(seed.state == TrackState::kTracking);
  CHECK(test::distance_px(seed, kStart) < 2);
}

TEST_CASE("a particle filter on the surface follows the puck and its size") {
  ParticleFilterEros filter(kSensor, {}, kSizeModel);
  RingScene scene(filter);
  scene.show_until_detected(kStart);
  PuckEstimate estimate;
  CHECK(scene.follow(kStart, 200, estimate) < 2);
  const PuckSize truth = kSizeModel.at({420, 250});
  CHECK(estimate.size.width == doctest::Approx(truth.width).epsilon(0.2));
  CHECK(estimate.size.height == doctest::Approx(truth.height).epsilon(0.2));
  CHECK(estimate.newest_event > scene.now());
}

TEST_CASE("a particle filter on the surface stands still while no events come") {
  ParticleFilterEros filter(kSensor, {}, kSizeModel);
  RingScene scene(filter);
  scene.show_until_detected(kStart);
  const PuckEstimate first = scene.show(kStart);
  const PuckEstimate again = filter.estimate();
  CHECK(*again.position == *first.position);
  CHECK(again.events_applied == first.events_applied);
}

TEST_CASE("a particle filter on the surface survives a puck that leaves the image") {
  ParticleFilterEros filter(kSensor, {}, kSizeModel);
  RingScene scene(filter);
  scene.show_until_detected({500, 190});
  PuckEstimate estimate;
  for (int i = 1; i <= 350; ++i) estimate = scene.show({500 + 0.6 * i, 190});
  CHECK(estimate.state == TrackState::kTracking);
  CHECK(estimate.position->x > 590);
  CHECK(estimate.position->x <= 639);
}

TEST_CASE("a particle filter on the surface refuses parameters out of range and names the key") {
  ParticleFilterErosParams params;
  params.lowest_likelihood = 2;
  CHECK(test::refusal([&] { ParticleFilterEros(kSensor, params, kSizeModel); }) ==
        "particle_filter.lowest_likelihood must be above 0 and at most 1, got 2.000000");
}

}  // namespace puck
