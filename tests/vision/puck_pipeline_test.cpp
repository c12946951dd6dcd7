#include "common/vision/paper/puck_pipeline.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "common/vision/paper/paper_presets.h"
#include "common/vision/presets.h"
#include "common/vision/surface_tracker.h"
#include "tests/support/sanitizers.h"
#include "tests/vision/puck_picture.h"
#include "tests/vision/test_sensor.h"

namespace puck {
namespace {

using test::kSensor;
using test::kSizeModel;

// About the authors' model: 29×20 px in the middle of their detection region.

// Feeds a pipeline with the contour of a puck, a step of the tracking thread each millisecond.
class Scene {
 public:
  explicit Scene(const PipelineParams& params) : tracker_(kSensor, params, kSizeModel) {}

  PuckEstimate show(Pixel centre) {
    return apply(test::contour_events(kSensor, centre, kSizeModel.at(centre), 150));
  }

  PuckEstimate show_upper_half(Pixel centre) {
    std::vector<Event> events = test::contour_events(kSensor, centre, kSizeModel.at(centre), 150);
    std::erase_if(events, [&](const Event& event) { return event.y > centre.y; });
    return apply(std::move(events));
  }

  PuckEstimate show_clutter() {
    std::vector<Event> events;
    for (int i = 0; i < 1000; ++i) {
      // A random walk through the image, without a ring.
      clutter_ = clutter_ * 1664525u + 1013904223u;
      events.push_back({static_cast<std::uint16_t>((clutter_ >> 8) % 640),
                        static_cast<std::uint16_t>((clutter_ >> 20) % 480), 0, 0});
    }
    return apply(std::move(events));
  }

  PuckEstimate step_without_events() { return tracker_.estimate(); }

  std::int64_t events_applied() const { return events_applied_; }

 private:
  PuckEstimate apply(std::vector<Event> events) {
    now_ = now_ + 1000;
    EventPacket packet{now_, std::move(events)};
    tracker_.update(packet);
    events_applied_ += static_cast<std::int64_t>(packet.events.size());
    return step_without_events();
  }

  SurfaceTracker tracker_;
  std::int64_t events_applied_ = 0;
  Timestamp now_;
  unsigned clutter_ = 1;
};

double distance(const PuckEstimate& estimate, Pixel truth) {
  if (!estimate.position) return 1e9;
  return std::hypot(estimate.position->x - truth.x, estimate.position->y - truth.y);
}

}  // namespace

TEST_CASE("every preset detects the puck in the detection region and follows it") {
  for (const Preset preset : {Preset::kPaper, Preset::kReference, Preset::kCorrelation}) {
    CAPTURE(std::string(to_string(preset)));
    Scene scene(preset_params(preset));
    PuckEstimate estimate;
    double worst = 0;
    for (int i = 0; i < 300; ++i) {
      const Pixel truth{200 + 0.6 * i, 190 + 0.3 * i};
      estimate = scene.show(truth);
      if (i >= 20) worst = std::max(worst, distance(estimate, truth));
    }
    CHECK(estimate.state == TrackState::kTracking);
    CHECK(worst < 4);
    CHECK(estimate.newest_event == Timestamp{300'000});
    CHECK(estimate.events_applied == scene.events_applied());
    CHECK(estimate.score > 0.15);
  }
}

TEST_CASE("there is no detection on an empty surface or in clutter without a ring") {
  constexpr int kSteps = kIsSanitized ? 25 : 100;  // Each searches the whole image.
  for (const Preset preset : {Preset::kReference, Preset::kCorrelation}) {
    CAPTURE(std::string(to_string(preset)));
    Scene scene(preset_params(preset));
    const PuckEstimate nothing = scene.step_without_events();
    CHECK(nothing.state == TrackState::kSearching);
    CHECK_FALSE(nothing.position.has_value());
  }
  Scene scene(correlation_params());
  for (int i = 0; i < kSteps; ++i) CHECK_FALSE(scene.show_clutter().position.has_value());
}

TEST_CASE("the soft ring follows a drawn contour to a tenth of a pixel") {
  PuckPipelineParams params = correlation_params();
  // Drawn events have no lag, no trail, and lie on the annotated contour.
  params.leads = false;
  params.contour.grow_px = 0;
  Scene scene(params);
  double mean_px = 0;
  for (int i = 0; i < 300; ++i) {
    const Pixel truth{200 + 0.37 * i, 190 + 0.21 * i};
    const PuckEstimate estimate = scene.show(truth);
    if (i >= 100) mean_px += distance(estimate, truth) / 200;
  }
  CHECK(mean_px < 0.1);
}

TEST_CASE("half a ring is no puck, for any time") {
  constexpr int kSteps = kIsSanitized ? 50 : 300;  // Each searches the whole image.
  Scene scene(correlation_params());
  int tracked = 0;
  for (int i = 0; i < kSteps; ++i) {
    if (scene.show_upper_half({200 + 0.5 * i, 190}).state == TrackState::kTracking) ++tracked;
  }
  CHECK(tracked == 0);
}

TEST_CASE("the default estimate has its velocity") {
  Scene scene(correlation_params());
  PuckEstimate estimate;
  for (int i = 0; i < 200; ++i) estimate = scene.show({200 + 1.0 * i, 190 + 0.5 * i});
  CHECK(estimate.velocity.x == doctest::Approx(1000).epsilon(0.1));
  CHECK(estimate.velocity.y == doctest::Approx(500).epsilon(0.1));
  CHECK_FALSE(estimate.resting);
  CHECK(estimate.covariance[0] > 0);
  CHECK(estimate.covariance[15] > 0);
}

TEST_CASE("a puck that stops is still tracked, and reported as resting") {
  Scene scene(correlation_params());
  for (int i = 0; i < 100; ++i) scene.show({200 + 1.0 * i, 190});
  PuckEstimate estimate;
  for (int i = 0; i < 300; ++i) estimate = scene.show({300, 190});
  CHECK(estimate.state == TrackState::kTracking);
  CHECK(estimate.resting);
  const PuckEstimate again = scene.step_without_events();
  CHECK(again.state == TrackState::kTracking);
  CHECK(distance(again, {300, 190}) < 1);
}

TEST_CASE("a puck that vanishes is lost soon after and found again elsewhere") {
  Scene scene(correlation_params());
  for (int i = 0; i < 100; ++i) scene.show({200 + 1.0 * i, 190});
  PuckEstimate estimate;
  int lost_after_ms = 0;
  for (int i = 1; i <= 200 && lost_after_ms == 0; ++i) {
    estimate = scene.show_clutter();
    if (estimate.state == TrackState::kLost) lost_after_ms = i;
  }
  CHECK(lost_after_ms > 0);
  CHECK(lost_after_ms <= 100);
  CHECK_FALSE(estimate.position.has_value());

  for (int i = 1; i <= 300; ++i) estimate = scene.show({390 + 0.2 * i, 350});
  CHECK(estimate.state == TrackState::kTracking);
  CHECK(distance(estimate, {450, 350}) < 2);
}

TEST_CASE("the paper's tracker never reports a loss") {
  Scene scene(paper_params());
  for (int i = 0; i < 100; ++i) scene.show({200 + 1.0 * i, 190});
  PuckEstimate estimate;
  for (int i = 0; i < 200; ++i) estimate = scene.show_clutter();
  CHECK(estimate.state == TrackState::kTracking);
}

TEST_CASE("the same events give the same estimates to the bit") {
  Scene first(correlation_params());
  Scene second(correlation_params());
  for (int i = 0; i < 150; ++i) {
    const Pixel truth{300 + 0.7 * i, 200 + 0.2 * i};
    const PuckEstimate a = first.show(truth);
    const PuckEstimate b = second.show(truth);
    REQUIRE(a.position == b.position);
    REQUIRE(a.score == b.score);
    REQUIRE(a.covariance == b.covariance);
  }
}

TEST_CASE("a size model with impossible sizes is clamped, and does not crash the tracker") {
  PuckPipelineParams params = correlation_params();
  for (const PuckSizeModel& model :
       {PuckSizeModel{1e9, 0, 0, 1e9, 0, 0}, PuckSizeModel{-50, 0, 0, -50, 0, 0},
        PuckSizeModel{std::nan(""), 0, 0, std::nan(""), 0, 0}}) {
    SurfaceTracker tracker(kSensor, params, model);
    PuckEstimate estimate;
    for (int i = 1; i < 20; ++i) {
      EventPacket packet{{i * 1000}, test::contour_events(kSensor, {320, 190}, {37, 25}, 100)};
      tracker.update(packet);
      estimate = tracker.estimate();
    }
    CHECK(estimate.events_applied > 0);
  }
}

TEST_CASE("the puck is followed to the image's border and the region stays inside the image") {
  Scene scene(correlation_params());
  for (int i = 0; i <= 330; ++i) {
    const PuckEstimate estimate = scene.show({320 + 1.0 * i, 190});
    const Region inside = estimate.region.intersect(Region::all_of(kSensor));
    REQUIRE((estimate.region.empty() || inside == estimate.region));
    if (i > 20 && i < 290) REQUIRE(distance(estimate, {320 + 1.0 * i, 190}) < 3);
  }
}

TEST_CASE("an estimate names its region: ROI_d first, then ROI_t around the puck") {
  Scene scene(reference_params());
  CHECK(scene.show({300, 190}).region == Region{60, 150, 500, 80});
  const Region first = scene.show({300, 190}).region;
  CHECK(first.width == 49);
  CHECK(first.height == 31);
  const Region next = scene.show({300, 190}).region;
  CHECK(next.width == 3 * 37);  // of the nominal size, which is the authors' box
  CHECK(next.contains(300, 190));
}

TEST_CASE("a detection region outside the sensor is refused") {
  PuckPipelineParams params = reference_params();
  params.detector.region = {700, 10, 20, 20};
  CHECK_THROWS_AS(PuckPipeline(kSensor, params, kSizeModel), std::invalid_argument);
}

}  // namespace puck
