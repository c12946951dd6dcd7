#include "common/baselines/cluster_tracker.h"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/baselines/refusal.h"
#include "tests/baselines/ring_scene.h"

namespace puck {
namespace {

using test::kSensor;
using test::kSizeModel;
using test::kStart;
using test::RingScene;

// A tracker that has just been seeded, to be fed with single events.
class SeededTracker {
 public:
  explicit SeededTracker(const ClusterTrackerParams& params = {})
      : tracker_(kSensor, params, kSizeModel),
        seed_(RingScene(tracker_).show_until_detected(kStart)) {
    REQUIRE(seed_.position.has_value());
  }

  const PuckEstimate& seed() const { return seed_; }

  // An event (dx, dy) px from the seed's position, `after_us` after the seed.
  PuckEstimate give(int dx, int dy, int after_us) {
    const Event event{static_cast<std::uint16_t>(seed_.position->x + dx),
                      static_cast<std::uint16_t>(seed_.position->y + dy), 1, 0};
    return give(event, after_us);
  }
  PuckEstimate give(const Event& event, int after_us) {
    tracker_.update(EventPacket{seed_.newest_event + after_us, {event}});
    return tracker_.estimate();
  }

 private:
  ClusterTracker tracker_;
  PuckEstimate seed_;
};

double square(double value) { return value * value; }

}  // namespace

TEST_CASE("a cluster is seeded only once the puck has been detected") {
  ClusterTracker tracker(kSensor, {}, kSizeModel);
  RingScene scene(tracker);
  const PuckEstimate before = scene.give({test::far_event()});
  CHECK(before.state == TrackState::kSearching);
  CHECK_FALSE(before.position.has_value());
  CHECK(before.events_applied == 1);
  const PuckEstimate after = scene.show_until_detected(kStart);
  CHECK(after.state == TrackState::kTracking);
  CHECK(test::distance_px(after, kStart) < 2);
  CHECK(after.newest_event > scene.now());
  CHECK(after.events_applied > 1);
}

TEST_CASE("a cluster's first size is the size model's") {
  const SeededTracker tracker;
  const PuckSize expected = kSizeModel.at(*tracker.seed().position);
  CHECK(tracker.seed().size.width == doctest::Approx(expected.width));
  CHECK(tracker.seed().size.height == doctest::Approx(expected.height));
}

TEST_CASE("an event moves the cluster a tenth of the way, and changes its velocity by a fifth") {
  SeededTracker tracker;
  const PuckEstimate moved = tracker.give(5, -3, 1000);
  CHECK(moved.position->x == doctest::Approx(tracker.seed().position->x + 0.5));
  CHECK(moved.position->y == doctest::Approx(tracker.seed().position->y - 0.3));
  // 0.5 and −0.3 px within 1 ms, weighed by 0.2.
  CHECK(moved.velocity.x == doctest::Approx(100));
  CHECK(moved.velocity.y == doctest::Approx(-60));
  CHECK(moved.events_applied == tracker.seed().events_applied + 1);
  CHECK(moved.newest_event - tracker.seed().newest_event == 1000);
}

TEST_CASE("an event at the same time as the one before does not change the velocity") {
  SeededTracker tracker;
  const PuckEstimate moved = tracker.give(5, 0, 0);
  CHECK(moved.position->x == doctest::Approx(tracker.seed().position->x + 0.5));
  CHECK(moved.velocity.x == 0);
}

TEST_CASE("a cluster shrinks with events near its centre and grows with those far from it") {
  ClusterTrackerParams params;
  params.max_distance_px = 20;
  SeededTracker shrinking(params);
  const PuckSize first = shrinking.seed().size;
  const PuckSize smaller = shrinking.give(0, 0, 1000).size;
  CHECK(square(smaller.width) == doctest::Approx(0.99 * square(first.width)));
  CHECK(square(smaller.height) == doctest::Approx(0.99 * square(first.height)));

  SeededTracker growing(params);
  const PuckSize wider = growing.give(15, 0, 1000).size;
  CHECK(square(wider.width) == doctest::Approx(0.99 * square(first.width) + 8 * 0.01 * 225));
  CHECK(square(wider.height) == doctest::Approx(0.99 * square(first.height)));
  CHECK(wider.width > first.width);
}

TEST_CASE("a round cluster grows alike in both directions") {
  ClusterTrackerParams params;
  params.max_distance_px = 20;
  params.round_shape = true;
  SeededTracker tracker(params);
  const PuckSize first = tracker.seed().size;
  const PuckSize next = tracker.give(15, 0, 1000).size;
  CHECK(square(next.width) == doctest::Approx(0.99 * square(first.width) + 8 * 0.01 * 112.5));
  CHECK(square(next.height) == doctest::Approx(0.99 * square(first.height) + 8 * 0.01 * 112.5));
}

TEST_CASE("a cluster ignores events at or beyond its largest distance") {
  SeededTracker tracker;
  const PuckEstimate at_limit = tracker.give(10, 0, 1000);
  CHECK(*at_limit.position == *tracker.seed().position);
  CHECK(at_limit.size.width == tracker.seed().size.width);
  CHECK(at_limit.events_applied == tracker.seed().events_applied + 1);
  const PuckEstimate inside = tracker.give(9, 0, 2000);
  CHECK(inside.position->x == doctest::Approx(tracker.seed().position->x + 0.9));
}

TEST_CASE("the largest distance can scale with the puck's width") {
  SeededTracker tracker(puck_cluster_params());
  // Three quarters of 28.6 px are 21.5 px.
  const PuckEstimate beyond = tracker.give(22, 0, 1000);
  CHECK(*beyond.position == *tracker.seed().position);
  const PuckEstimate within = tracker.give(21, 0, 2000);
  CHECK(within.position->x == doctest::Approx(tracker.seed().position->x + 2.1));
}

TEST_CASE("a cluster's score decays without events of its own, at any interval of the updates") {
  SeededTracker once;
  CHECK(once.seed().score == doctest::Approx(1));
  CHECK(once.give(test::far_event(), 10'000).score == doctest::Approx(std::exp(-1.0)));

  SeededTracker often;
  PuckEstimate estimate;
  for (int i = 1; i <= 200; ++i) estimate = often.give(test::far_event(), 50 * i);
  CHECK(estimate.score == doctest::Approx(std::exp(-1.0)));
  CHECK(estimate.state == TrackState::kTracking);
  CHECK(*estimate.position == *often.seed().position);
}

TEST_CASE("a cluster with room for the whole contour follows the puck") {
  ClusterTracker tracker(kSensor, puck_cluster_params(), kSizeModel);
  RingScene scene(tracker);
  scene.show_until_detected(kStart);
  PuckEstimate estimate;
  CHECK(scene.follow(kStart, 300, estimate) < 4);
  const PuckSize truth = kSizeModel.at({480, 280});
  CHECK(estimate.size.width == doctest::Approx(truth.width).epsilon(0.2));
  CHECK(estimate.size.height == doctest::Approx(truth.height).epsilon(0.2));
  CHECK(estimate.score == 1);
}

TEST_CASE("a cluster refuses parameters out of range and names the key") {
  const auto refusal = [](auto change) {
    ClusterTrackerParams params;
    change(params);
    return test::refusal([&] { ClusterTracker(kSensor, params, kSizeModel); });
  };
  CHECK(refusal([](auto&) {}).empty());
  CHECK(refusal([](auto& p) { p.position_share = 0; }) ==
        "cluster.position_share must be above 0 and at most 1, got 0.000000");
  CHECK(refusal([](auto& p) { p.shape_share = 1.5; }).starts_with("cluster.shape_share must"));
  CHECK(refusal([](auto& p) {
          p.velocity_share = std::nan("");
        }).starts_with("cluster.velocity_share must"));
  CHECK(
      refusal([](auto& p) { p.max_distance_px = 0; }).starts_with("cluster.max_distance_px must"));
  CHECK(refusal([](auto& p) {
          p.max_distance_widths = -1;
        }).starts_with("cluster.max_distance_widths must"));
  CHECK(refusal([](auto& p) { p.active_from = 0; }).starts_with("cluster.active_from must"));
  CHECK(refusal([](auto& p) {
          p.activity_decay_us = 0;
        }).starts_with("cluster.activity_decay_us must"));
  CHECK(refusal([](auto& p) { p.regulation_events = 0; }) ==
        "cluster.regulation_events must be at least 1, got 0");
}

}  // namespace puck
