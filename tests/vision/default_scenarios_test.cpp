// How preset `default` tracks a puck that glides, rests, bounces, is covered or leaves the image.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "common/vision/interfaces/event_pieces.h"
#include "common/vision/make_pipeline.h"
#include "common/vision/presets.h"
#include "common/vision/surface_tracker.h"
#include "tests/support/sanitizers.h"
#include "tests/vision/contour_table.h"
#include "tests/vision/moving_contour.h"

namespace puck {
namespace {

// Of the noise. They all take the same ways through the code, so sanitizers see one; as they do of
// the cases that search for long.
constexpr std::uint32_t kSeeds = kIsSanitized ? 1 : 3;

// What the tracker cannot do yet: a puck at rest drifts in noise, and is left for a mallet. The
// test of a scenario fails once it can.
const doctest::should_fail kNotYet;

using Table = test::ContourTable;
using test::kTableSensor;
using test::kTableSizeModel;

TEST_CASE("a moving puck is found without help and followed to a fraction of a pixel") {
  Table table;
  CHECK(table.glide({700, 200}, 200) < 0.2);
  CHECK(table.estimate().state == TrackState::kTracking);
  CHECK(table.estimate().velocity.x == doctest::Approx(700).epsilon(0.05));
  CHECK(table.estimate().score > 0.8);
  CHECK(table.estimate().covariance[0] > 0);
  CHECK(table.estimate().covariance[0] < 1);
}

TEST_CASE("a fast puck is found by searches whose answers come late") {
  HypothesesParams params = default_params();
  params.search_delay_us = 15'000;
  Table table(params);
  table.glide({1500, 300}, 100);
  CHECK(table.estimate().state == TrackState::kTracking);
  CHECK(table.error_px() < 1);
}

TEST_CASE("a puck that bounces is followed on") {
  Table table;
  table.glide({900, 100}, 150);
  table.glide({-800, 100}, 10);
  CHECK(table.glide({-800, 100}, 60) < 0.3);
}

TEST_CASE("a puck with a print on its face is found and followed") {
  Table table;
  table.has_print = true;
  table.glide({700, 200}, 150);
  CHECK(table.glide({700, 200}, 200) < 0.3);
}

TEST_CASE("a puck with a print is found where a plain one was covered and is gone") {
  Table table;
  table.density = 6;
  table.glide({400, 100}, 400);
  table.rest(300);
  REQUIRE(table.estimate().resting);
  table.cover(200);
  table.rest(500);
  table.put({80, 60});
  table.has_print = true;
  table.glide({700, 200}, 50);
  CHECK(table.glide({700, 200}, 150) < 0.3);
}

TEST_CASE("a puck that stops keeps its place without events") {
  Table table;
  table.glide({600, 100}, 200);
  table.rest(1000);
  CHECK(table.estimate().state == TrackState::kTracking);
  CHECK(table.estimate().resting);
  CHECK(table.error_px() < 1.5);
  table.glide({0, 700}, 20);
  CHECK(table.glide({0, 700}, 40) < 0.3);
}

// As many for each px² as of 12,000 events a second in an image of 640 by 480.
// It drifts too far after some ten seconds.
TEST_CASE("a puck that rests in noise keeps its place for half a minute, and is followed on" *
          doctest::should_fail(!kIsSanitized)) {
  constexpr int kSeconds = kIsSanitized ? 8 : 30;
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    CAPTURE(seed);
    Table table(default_params(), seed);
    table.glide({600, 100}, 200);
    table.glide({200, 30}, 50);
    table.glide({80, 10}, 50);
    for (int second = 0; second < kSeconds; ++second) {
      CAPTURE(second);
      table.rest(1000, 3);
      REQUIRE(table.estimate().state == TrackState::kTracking);
      REQUIRE(table.estimate().resting);
      REQUIRE(table.error_px() < 1.5);
    }
    table.glide({0, 700}, 20);
    CHECK(table.glide({0, 700}, 40) < 0.3);
  }
}

TEST_CASE(
    "a puck that comes to rest slowly is not left for a mallet, and is followed from its hit on") {
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    CAPTURE(seed);
    Table table(default_params(), seed);
    table.come_to_rest();
    REQUIRE(table.estimate().resting);
    CHECK(table.error_px() < 1);
    for (int i = 0; i < 9; ++i) {
      table.approach({0, -70.0 + 5 * i}, {0, 500}, 10);
      CHECK(table.estimate().state == TrackState::kTracking);
      CHECK(table.error_px() < 1.5);
    }
    table.glide({0, 1500}, 2);
    CHECK(table.error_px() < 2);
  }
}

// Whether a puck that comes to rest before a noisy sensor, 3 Hz a pixel, is tracked all the while.
bool rests_in_noise(const HypothesesParams& params, std::uint32_t seed) {
  Table table(params, seed);
  table.noise_a_ms = 230;
  table.come_to_rest();
  for (int i = 0; i < 100; ++i) {
    table.rest(10);
    if (table.estimate().state != TrackState::kTracking || table.error_px() > 1.5) return false;
  }
  return table.estimate().resting;
}

TEST_CASE("a puck at rest is not lost in the sensor's noise" * kNotYet) {
  for (std::uint32_t seed = 1; seed <= std::min(kSeeds, 2u); ++seed) {
    CAPTURE(seed);
    CHECK(rests_in_noise(default_params(), seed));
  }
}

TEST_CASE("a puck that is covered at rest is lost, or stays where it is") {
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    CAPTURE(seed);
    Table table(default_params(), seed);
    table.come_to_rest();
    REQUIRE(table.estimate().state == TrackState::kTracking);
    for (int i = 0; i < 30; ++i) {
      CAPTURE(i);
      table.cover(1);
      if (table.estimate().state == TrackState::kTracking) CHECK(table.error_px() < 5);
    }
  }
}

TEST_CASE("a mallet that trembles beside a puck at rest for 3 s does not lead the track away") {
  for (std::uint32_t seed = 1; seed <= std::min(kSeeds, 2u); ++seed) {
    CAPTURE(seed);
    Table table(default_params(), seed);
    table.come_to_rest();
    for (int i = 0; i < 60; ++i) {
      table.approach({0, -26}, {0, 200}, 10);
      table.approach({0, -24}, {0, -200}, 10);
      table.rest(30, 3);
    }
    CHECK(table.estimate().state == TrackState::kTracking);
    CHECK(table.error_px() < 3);
  }
}

// How far off the track of a puck at rest is at worst while a mallet comes down to it and draws
// back for 60 ms; 100 if it is lost.
double worst_px_beside_mallet(double beside_px, int down_ms, PixelVelocity back,
                              std::uint32_t seed) {
  Table table(default_params(), seed);
  table.come_to_rest();
  table.approach({beside_px, -70}, {0, 500}, down_ms);
  const Pixel nearest{beside_px, -70 + 0.5 * down_ms};
  double worst_px = 0;
  for (int i = 0; i < 60; ++i) {
    table.approach({nearest.x + back.x * i * 1e-3, nearest.y + back.y * i * 1e-3}, back, 1);
    worst_px = std::max(worst_px, table.error_px());
  }
  return worst_px;
}

TEST_CASE("a mallet that touches a puck at rest and draws back does not take the track with it" *
          kNotYet) {
  struct Scene {
    double beside_px;
    int down_ms;
    PixelVelocity back;
  };
  for (std::uint32_t seed = 1; seed <= std::min(kSeeds, 2u); ++seed) {
    CAPTURE(seed);
    for (const Scene& scene :
         {Scene{-20, 112, {-400, 0}}, {-10, 108, {-200, -150}}, {-10, 104, {400, -150}}}) {
      CAPTURE(scene.back.x);
      CHECK(worst_px_beside_mallet(scene.beside_px, scene.down_ms, scene.back, seed) < 1.5);
    }
  }
}

TEST_CASE("a faint puck is followed when it sets off slowly") {
  for (std::uint32_t seed = 1; seed <= std::min(kSeeds, 2u); ++seed) {
    CAPTURE(seed);
    Table table(default_params(), seed);
    table.density = 1;
    table.come_to_rest();
    double worst_px = 0;
    for (int i = 0; i < 100; ++i) {
      table.glide({100, 30}, 1);
      worst_px = std::max(worst_px, table.error_px());
    }
    CHECK(worst_px < 5);
    CHECK(table.error_px() < 1);
  }
}

TEST_CASE("a puck that begins to move after long noise is found within a tenth of a second") {
  for (const bool was_known : {false, true}) {
    CAPTURE(was_known);
    Table table;
    if (was_known) {
      table.glide({600, 100}, 200);
      table.cover(100);
      CHECK(table.estimate().state == TrackState::kLost);
    }
    table.rest(2500, 3);
    table.put({250, 180});
    table.glide({-500, -200}, 100);
    CHECK(table.estimate().state == TrackState::kTracking);
    CHECK(table.error_px() < 0.5);
  }
}

TEST_CASE("a puck that is covered is lost within a tenth of a second and found again elsewhere") {
  Table table;
  table.glide({600, 100}, 200);
  table.cover(100);
  CHECK(table.estimate().state == TrackState::kLost);
  CHECK_FALSE(table.estimate().position.has_value());
  table.put({250, 180});
  table.glide({-500, -200}, 120);
  CHECK(table.estimate().state == TrackState::kTracking);
  CHECK(table.error_px() < 0.5);
}

TEST_CASE("a puck that was covered without a sign is followed where it comes out") {
  for (std::uint32_t seed = 1; seed <= std::min(kSeeds, 2u); ++seed) {
    CAPTURE(seed);
    Table table(default_params(), seed);
    table.come_to_rest();
    table.put({80, 200});
    table.glide({300, -100}, 400);
    CHECK(table.glide({-300, 50}, 400) < 1);
  }
}

TEST_CASE("a puck that leaves the image is known to have left, and where") {
  Table table;
  table.glide({1500, 0}, 190);
  table.rest(60);
  CHECK(table.estimate().state == TrackState::kLost);
  REQUIRE(table.estimate().left_image.has_value());
  CHECK(table.estimate().left_image->x == 319);
  CHECK(std::abs(table.estimate().left_image->y - 100) < 3);
}

// A puck that has been beyond doubt, and left by the right side at 3500 px/s so long ago.
void let_leave(Table& table, int away_ms) {
  table.noise_a_ms = 3;
  table.glide({300, 0}, 400);
  REQUIRE(table.error_px() < 1);
  table.glide({3'500, 0}, 40 + away_ms);
  REQUIRE(table.estimate().state == TrackState::kLost);
  REQUIRE(table.estimate().left_image.has_value());
}

TEST_CASE("a fast puck that comes back elsewhere over the image's side is soon found") {
  // Summed over how long it is away, since searches fall when they fall.
  int milliseconds = 0;
  for (const int away_ms : {14, 18, 22, 26}) {
    Table table;
    let_leave(table, away_ms);
    table.put({319 + 3.5 * away_ms, 200});
    // Back to where half of it is seen.
    table.glide({-3'500, 300}, away_ms + 1);
    for (; table.error_px() > 5 && milliseconds < 200; ++milliseconds) {
      table.glide({-3'500, 300}, 1);
    }
  }
  CHECK(milliseconds < 60);
}

TEST_CASE("random events are never a puck") {
  Table table;
  table.cover(300);
  table.rest(100);
  CHECK(table.estimate().state == TrackState::kSearching);
}

// Of a puck whose annotations leave its wall out.
PuckSizeModel half_face_model() {
  PuckSizeModel model = kTableSizeModel;
  model.disc = DiscModel{.width_0 = 16,
                         .width_y = 0.08,
                         .face_on_px = 60,
                         .principal_x_px = 160,
                         .principal_y_px = 120};
  return model;
}

TEST_CASE("a puck is followed whose side wall makes events below the face that was annotated") {
  const PuckSizeModel model = half_face_model();
  REQUIRE(PuckContour(kTableSensor, model, {0, 0, 0}).other_wall_share() < -0.1);
  for (const bool has_wall : {false, true}) {
    CAPTURE(has_wall);
    Table table(default_params(), 1, model);
    if (has_wall) table.show_other_wall();
    CHECK(table.glide({700, 200}, 300) < 0.2);
    CHECK(table.estimate().state == TrackState::kTracking);
  }
}

TEST_CASE("the same events give the same estimates, however often one asks") {
  const auto run = [](int asks) {
    SurfaceTracker tracker(kTableSensor, default_params(), kTableSizeModel);
    const PuckContour contour(kTableSensor, kTableSizeModel, {});
    test::MovingContour puck(contour, {60, 100}, {700, 200});
    PuckEstimate last;
    for (int i = 0; i < 100; ++i) {
      const std::int64_t from_us = i * 1000;
      const EventPacket packet =
          test::packet_of(puck.events(from_us, from_us + 1000), kTableSensor, from_us, from_us);
      if (packet.empty()) continue;
      tracker.update(packet);
      for (int n = 0; n < asks; ++n) last = tracker.estimate();
    }
    return tracker.estimate();
  };
  const PuckEstimate seldom = run(0);
  const PuckEstimate often = run(2);
  REQUIRE(seldom.position.has_value());
  REQUIRE(often.position.has_value());
  CHECK(*seldom.position == *often.position);
}

TEST_CASE("no estimate depends on when the rest of the work is done") {
  const auto run = [](unsigned worked_off_of_4) {
    const std::unique_ptr<TrackingPipeline> pipeline =
        make_pipeline(kTableSensor, default_params(), kTableSizeModel);
    const PuckContour contour(kTableSensor, kTableSizeModel, {});
    test::MovingContour puck(contour, {60, 100}, {1500, 300});
    std::vector<PuckEstimate> estimates;
    for (int i = 0; i < 60; ++i) {
      const std::int64_t from_us = i * 1000;
      const EventPacket packet =
          test::packet_of(puck.events(from_us, from_us + 1000), kTableSensor, from_us, from_us);
      for_each_piece(packet.start, packet.events, 250, [&](std::span<const Event> piece) {
        pipeline->take(packet.start, piece);
        const Timestamp time = packet.start + piece.back().offset_us;
        SearchResult found{time, pipeline->search_wanted(), {}};
        if (!found.request.region.empty()) {
          found.candidates.push_back({puck.position_at(from_us), 0.8});
          pipeline->take(found);
        }
        SurfaceSnapshot snapshot;
        snapshot.newest_event = time;
        if (estimates.size() % 4 < worked_off_of_4) pipeline->work_off();
        estimates.push_back(pipeline->step(snapshot));
      });
    }
    return estimates;
  };
  const std::vector<PuckEstimate> never = run(0);
  REQUIRE(never.back().position.has_value());
  for (const unsigned often : {1U, 3U, 4U}) {
    const std::vector<PuckEstimate> some = run(often);
    REQUIRE(some.size() == never.size());
    for (std::size_t i = 0; i < some.size(); ++i) {
      CAPTURE(i);
      REQUIRE(some[i].state == never[i].state);
      REQUIRE(some[i].position == never[i].position);
      REQUIRE(some[i].covariance == never[i].covariance);
      REQUIRE(some[i].score == never[i].score);
    }
  }
}

}  // namespace
}  // namespace puck
