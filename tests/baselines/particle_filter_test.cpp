#include "common/baselines/particle_filter.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "tests/baselines/refusal.h"
#include "tests/baselines/ring_scene.h"

namespace puck {
namespace {

using test::kSensor;
using test::kSizeModel;
using test::kStart;
using test::RingScene;

int events_for_an_update(const PuckEstimate& seed) {
  return static_cast<int>(
      std::ceil(std::numbers::pi * ParticleTemplate::radius_of_width(seed.size.width)));
}

// Events beside the puck, inside the filter's region but outside every particle's.
std::vector<Event> corner_events(const PuckEstimate& seed, int count) {
  const Event corner{static_cast<std::uint16_t>(seed.position->x + 34),
                     static_cast<std::uint16_t>(seed.position->y + 34), 1, 0};
  return std::vector<Event>(static_cast<std::size_t>(count), corner);
}

}  // namespace

TEST_CASE("a particle filter is seeded only once the puck has been detected") {
  ParticleFilter filter(kSensor, {}, kSizeModel);
  RingScene scene(filter);
  const PuckEstimate before = scene.give({test::far_event()});
  CHECK(before.state == TrackState::kSearching);
  CHECK_FALSE(before.position.has_value());
  const PuckEstimate seed = scene.show_until_detected(kStart);
  CHECK(seed.state == TrackState::kTracking);
  CHECK(test::distance_px(seed, kStart) < 2);
  CHECK(seed.size.width == doctest::Approx(kSizeModel.at(*seed.position).width));
  CHECK(seed.size.height == doctest::Approx(kSizeModel.at(*seed.position).height).epsilon(0.02));
  CHECK(seed.score == 0);
}

TEST_CASE("the particles are updated every π·R events near the puck, and far ones do not count") {
  ParticleFilter filter(kSensor, {}, kSizeModel);
  RingScene scene(filter);
  const PuckEstimate seed = scene.show_until_detected(kStart);
  const int needed = events_for_an_update(seed);
  CHECK(needed == 48);  // 28.6 px wide: R = 15.1 px
  const PuckEstimate far = scene.give(std::vector<Event>(500, test::far_event()));
  CHECK(*far.position == *seed.position);
  CHECK(far.events_applied == seed.events_applied);
  const PuckEstimate nearly = scene.give(corner_events(seed, needed - 1));
  CHECK(nearly.events_applied == seed.events_applied);
  CHECK(nearly.newest_event == seed.newest_event);
  const PuckEstimate updated = scene.give(corner_events(seed, 1));
  CHECK(updated.events_applied == seed.events_applied + 500 + needed);
  CHECK(updated.newest_event == scene.now());
  CHECK(updated.score > 0);
}

TEST_CASE("particles without any support have 3 % of the best likelihood") {
  ParticleFilterParams params;
  params.shape = TemplateShape::kReference;
  // Without the ring of the puck's detection.
  params.smallest_window_events = 1;
  ParticleFilter filter(kSensor, params, kSizeModel);
  RingScene scene(filter);
  const PuckEstimate seed = scene.show_until_detected(kStart);
  const PuckEstimate updated = scene.give(corner_events(seed, events_for_an_update(seed)));
  CHECK(updated.events_applied > seed.events_applied);
  CHECK(updated.score == doctest::Approx(0.03));
  CHECK(updated.state == TrackState::kTracking);
}

TEST_CASE("the events before the detection fill the window") {
  // With a full window the first update includes the ring from before the detection.
  ParticleFilter filter(kSensor, {}, kSizeModel);
  RingScene scene(filter);
  const PuckEstimate seed = scene.show_until_detected(kStart);
  const PuckEstimate updated = scene.give(corner_events(seed, events_for_an_update(seed)));
  CHECK(updated.score > 0.3);
  CHECK(test::distance_px(updated, kStart) < 3);
}

TEST_CASE("a particle filter follows the puck with either template") {
  for (const TemplateShape shape : {TemplateShape::kEllipse, TemplateShape::kReference}) {
    ParticleFilterParams params;
    params.shape = shape;
    ParticleFilter filter(kSensor, params, kSizeModel);
    RingScene scene(filter);
    scene.show_until_detected(kStart);
    PuckEstimate estimate;
    CHECK(scene.follow(kStart, 200, estimate) < 4);
    CHECK(estimate.state == TrackState::kTracking);
    CHECK(estimate.size.width == doctest::Approx(kSizeModel.at({420, 250}).width).epsilon(0.3));
  }
}

TEST_CASE("a window with 30 unused events is shortened, but not below 300") {
  const ParticleFilterParams params;
  CHECK(events_to_keep(530, 500, params) == 530);
  CHECK(events_to_keep(532, 500.9, params) == 500);
  CHECK(events_to_keep(531, 20, params) == 300);
  CHECK(events_to_keep(200, 20, params) == 200);
}

TEST_CASE("a particle filter refuses parameters out of range and names the key") {
  const auto refusal = [](auto change) {
    ParticleFilterParams params;
    change(params);
    return test::refusal([&] { ParticleFilter(kSensor, params, kSizeModel); });
  };
  CHECK(refusal([](auto&) {}).empty());
  CHECK(
      refusal([](auto& p) { p.set.particles = -5; }).starts_with("particle_filter.particles must"));
  CHECK(refusal([](auto& p) {
          p.lowest_likelihood = 0;
        }).starts_with("particle_filter.lowest_likelihood must"));
  CHECK(refusal([](auto& p) {
          p.region_margin_px = -1;
        }).starts_with("particle_filter.region_margin_px must"));
  CHECK(refusal([](auto& p) {
          p.smallest_window_events = 0;
        }).starts_with("particle_filter.smallest_window_events must"));
  CHECK(refusal([](auto& p) { p.largest_window_events = 299; }) ==
        "particle_filter.largest_window_events must be at least 300, got 299");
  CHECK(refusal([](auto& p) {
          p.window_slack_events = -1;
        }).starts_with("particle_filter.window_slack_events must"));
}

}  // namespace puck
