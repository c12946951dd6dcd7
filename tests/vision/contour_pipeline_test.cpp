#include "common/vision/contour_pipeline.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "common/vision/event_pieces.h"
#include "common/vision/make_pipeline.h"
#include "common/vision/presets.h"
#include "common/vision/surface_tracker.h"
#include "common/vision/takeover.h"
#include "tests/support/sanitizers.h"
#include "tests/vision/contour_world.h"

namespace puck {
namespace {

// Of the noise. They all take the same ways through the code, so sanitizers see one; as they do of
// the cases that search for long.
constexpr std::uint32_t kSeeds = kIsSanitized ? 1 : 3;

constexpr SensorSize kHalfSensor{320, 240};
constexpr PuckSizeModel kHalfSizeModel{16, 0, 0.08, 8, 0, 0.08};

// What searches find from some time on, and nothing else; a puck of the calibrated wall.
struct Imagined {
  Pixel start;
  PixelVelocity velocity;
  std::int64_t since_us = 0;

  Pixel position_at(std::int64_t time_us) const {
    const double passed_s = static_cast<double>(time_us - since_us) * 1e-6;
    return {start.x + velocity.x * passed_s, start.y + velocity.y * passed_s};
  }
};

// A pipeline, and what it wanted to be searched for: o for the other wall, c for the calibrated
// one. It may be told something imagined.
class NotedSearches final : public TrackingPipeline {
 public:
  NotedSearches(std::unique_ptr<TrackingPipeline> pipeline, std::string& noted,
                const std::optional<Imagined>& imagined, const PuckContour& contour)
      : pipeline_(std::move(pipeline)), noted_(noted), imagined_(imagined), contour_(contour) {}

  Region events_needed() const override { return pipeline_->events_needed(); }
  std::int64_t decision_period_us() const override { return pipeline_->decision_period_us(); }
  void take(Timestamp start, std::span<const Event> events) override {
    pipeline_->take(start, events);
  }
  Region region_needed() const override { return pipeline_->region_needed(); }
  PuckEstimate step(const SurfaceSnapshot& snapshot) override { return pipeline_->step(snapshot); }
  SearchRequest search_wanted() override {
    const SearchRequest wanted = pipeline_->search_wanted();
    if (!wanted.region.empty()) noted_ += wanted.other_wall ? 'o' : 'c';
    return wanted;
  }
  void take(const SearchResult& result) override {
    if (!imagined_) return pipeline_->take(result);
    SearchResult told = result;
    told.candidates = {{contour_.centre_with_wall(imagined_->position_at(result.time.us),
                                                  contour_.calibrated_wall_share(),
                                                  contour_.wall_share(result.request.other_wall)),
                        0.55}};
    pipeline_->take(told);
  }

 private:
  std::unique_ptr<TrackingPipeline> pipeline_;
  std::string& noted_;
  const std::optional<Imagined>& imagined_;
  const PuckContour& contour_;
};

// Shows a tracker of preset `default` a dark puck that glides, rests, jumps or hides.
class Table {
 public:
  explicit Table(const PipelineParams& params = preset_params(Preset::kDefault),
                 std::uint32_t seed = 1, const PuckSizeModel& size_model = kHalfSizeModel)
      : contour_(kHalfSensor, size_model, exact(), true),
        tracker_(kHalfSensor, with_exact(params), size_model,
                 std::make_unique<NotedSearches>(
                     make_pipeline(kHalfSensor, with_exact(params), size_model), searches_,
                     imagined_, contour_)),
        random_(seed) {}

  // Lets the puck glide for so long; the mean error of the last half, px.
  double glide(PixelVelocity velocity, int milliseconds) {
    test::MovingContour puck(contour_, puck_, velocity, density, wall_share_);
    puck.has_print = has_print;
    double sum = 0;
    for (int i = 0; i < milliseconds; ++i) {
      const std::int64_t from_us = i * 1000;
      show(test::packet_of(puck.events(from_us, from_us + 1000), kHalfSensor, now_us_, from_us));
      puck_ = puck.position_at(from_us + 1000);
      if (i >= milliseconds / 2) sum += error_px();
    }
    return sum / (milliseconds - milliseconds / 2);
  }

  // Slows down until nothing is left but noise.
  void come_to_rest() {
    glide({250, 30}, 500);
    for (const double speed : {120, 80, 50, 30}) glide({speed, 0}, 40);
    rest(500, 3);
  }

  // Nothing moves but a few pixels that fire at random, so many a millisecond.
  void rest(int milliseconds, int pixels = 1) {
    for (int i = 0; i < milliseconds; ++i) {
      EventPacket packet{{now_us_}, {}};
      for (int n = 0; n < pixels; ++n) packet.events.push_back(stray(500 + n));
      show(packet);
    }
  }

  // Something covers the puck: events of both signs all over it.
  void cover(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) {
      EventPacket packet{{now_us_}, {}};
      for (int n = 0; n < 100; ++n) {
        random_ = random_ * 1664525u + 1013904223u;
        packet.events.push_back({static_cast<std::uint16_t>(puck_.x - 30 + (random_ >> 8) % 60),
                                 static_cast<std::uint16_t>(puck_.y - 30 + (random_ >> 20) % 60),
                                 static_cast<std::uint16_t>((random_ >> 30) & 1),
                                 static_cast<std::uint32_t>(n * 10)});
      }
      show(packet);
    }
  }

  // The rounded front of something comes from that far away at that velocity.
  void approach(Pixel offset, PixelVelocity velocity, int milliseconds) {
    test::MovingContour mallet(contour_, {puck_.x + offset.x, puck_.y + offset.y}, velocity);
    for (int i = 0; i < milliseconds; ++i) {
      const std::int64_t from_us = i * 1000;
      std::vector<ContourEvent> front = mallet.events(from_us, from_us + 1000);
      const double y = mallet.position_at(from_us).y;
      std::erase_if(front, [&](const ContourEvent& event) { return event.y < y; });
      show(test::packet_of(front, kHalfSensor, now_us_, from_us));
    }
  }

  // Events that a px of contour makes on each px of its way.
  double density = 3;
  // Pixels that fire at random all the while, so many a millisecond.
  int noise_a_ms = 0;
  // There is a print on the puck's face.
  bool has_print = false;
  // The puck's side wall makes events where the calibration says that it does not.
  void show_other_wall() { wall_share_ = contour_.other_wall_share(); }
  // … and is so high, in widths in the image's middle, where the annotations leave it out.
  void show_wall(double height) {
    contour_.correct_other_wall_share(-height);
    show_other_wall();
  }
  void put(Pixel position) { puck_ = position; }
  // Searches find nothing but this, from now on.
  void imagine(Pixel start, PixelVelocity velocity) { imagined_ = {start, velocity, now_us_}; }
  double from_imagined_px() const {
    if (!estimate_.position) return 100;
    return distance_px(*estimate_.position, imagined_->position_at(now_us_));
  }
  double error_px() const {
    if (!estimate_.position) return 100;
    return distance_px(*estimate_.position, puck_);
  }
  const PuckEstimate& estimate() const { return estimate_; }
  // NotedSearches since the last call.
  std::string searches() { return std::exchange(searches_, {}); }

 private:
  static ContourCalibration exact() { return {0, 0, 0}; }
  static PipelineParams with_exact(PipelineParams params) {
    params.contour.calibration = exact();
    return params;
  }

  void add_noise(EventPacket& packet) {
    for (int n = 0; n < noise_a_ms; ++n) packet.events.push_back(stray(n * 1000 / noise_a_ms));
    std::stable_sort(packet.events.begin(), packet.events.end(),
                     [](const Event& a, const Event& b) { return a.offset_us < b.offset_us; });
  }

  Event stray(int offset_us) {
    random_ = random_ * 1664525u + 1013904223u;
    const std::uint32_t x = (random_ >> 8) % 320;
    random_ = random_ * 1664525u + 1013904223u;
    const std::uint32_t y = (random_ >> 8) % 240;
    return {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
            static_cast<std::uint16_t>(random_ >> 31), static_cast<std::uint32_t>(offset_us)};
  }

  void show(EventPacket packet) {
    if (noise_a_ms > 0) add_noise(packet);
    if (!packet.empty()) tracker_.update(packet);
    now_us_ += 1000;
    estimate_ = tracker_.estimate();
  }

  PuckContour contour_;
  double wall_share_ = 0;
  std::string searches_;
  std::optional<Imagined> imagined_;
  SurfaceTracker tracker_;
  Pixel puck_{60, 100};
  PuckEstimate estimate_;
  std::int64_t now_us_ = 0;
  std::uint32_t random_;
};

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
  PipelineParams params = preset_params(Preset::kDefault);
  params.search_delay_us = 15'000;
  Table table(params);
  table.glide({1500, 300}, 100);
  CHECK(table.estimate().state == TrackState::kTracking);
  CHECK(table.error_px() < 1);
}

TEST_CASE("while the answer of a search is awaited, events are taken wherever it looks") {
  const Region image = Region::all_of(kHalfSensor);
  PipelineParams params = preset_params(Preset::kDefault);
  params.contour.calibration = {0, 0, 0};
  // It would watch all of the image as well.
  params.contour.ingredients.early_background = false;
  const auto pipeline = make_pipeline(kHalfSensor, params, kHalfSizeModel);
  const PuckContour contour(kHalfSensor, kHalfSizeModel, params.contour.calibration, true);
  test::MovingContour puck(contour, {60, 100}, {150, 30});
  int awaited = 0;
  bool has_answered = false;
  std::optional<SearchResult> answer;
  std::int64_t wanted_us = 0;
  for (std::int64_t t = 0; t < 1'200'000; t += 500) {
    const EventPacket packet = test::packet_of(puck.events(t + 1, t + 501), kHalfSensor, t, t);
    if (packet.empty()) continue;
    pipeline->take(packet.start, packet.events);
    // A track that is not trusted yet watches all of the image anyway.
    if (has_answered && t > 500'000) CHECK(pipeline->events_needed().width < image.width);
    has_answered = false;
    if (!answer) {
      answer = {{t + 500}, pipeline->search_wanted(), {{puck.position_at(t + 500), 0.8}}};
      if (answer->request.region.empty()) answer.reset();
      wanted_us = t;
    }
    if (!answer) continue;
    const bool is_wide = answer->request.region == image;
    if (is_wide) CHECK(pipeline->events_needed() == image);
    if (t < wanted_us + 3'000) continue;
    if (is_wide && t > 500'000) ++awaited;
    pipeline->take(*answer);
    has_answered = is_wide;
    answer.reset();
  }
  CHECK(awaited > 0);
}

TEST_CASE("a puck that bounces is followed on") {
  Table table;
  table.glide({900, 100}, 150);
  table.glide({-800, 100}, 10);
  CHECK(table.glide({-800, 100}, 60) < 0.3);
}

TEST_CASE("a puck with a print on its face is found and followed, unless face-print is off") {
  const auto error_px = [](bool face_print) {
    PipelineParams params = preset_params(Preset::kDefault);
    params.contour.ingredients.face_print = face_print;
    Table table(params);
    table.has_print = true;
    table.glide({700, 200}, 150);
    return table.glide({700, 200}, 200);
  };
  CHECK(error_px(true) < 0.3);
  CHECK(error_px(false) > 5);
}

TEST_CASE(
    "what comes over a slow puck whose face is known to be plain is no print, unless plain-face is "
    "off") {
  const auto score = [](bool plain_face) {
    PipelineParams params = preset_params(Preset::kDefault);
    params.contour.ingredients.plain_face = plain_face;
    Table table(params);
    table.density = 6;
    table.glide({400, 200}, 350);
    table.glide({80, 40}, 100);
    table.has_print = true;
    table.glide({80, 40}, 30);
    return table.estimate().score;
  };
  CHECK(score(true) < 0.7);
  CHECK(score(false) > 0.85);
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
TEST_CASE("a puck that rests in noise keeps its place for half a minute, and is followed on") {
  constexpr int kSeconds = kIsSanitized ? 8 : 30;
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    CAPTURE(seed);
    Table table(preset_params(Preset::kDefault), seed);
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
    Table table(preset_params(Preset::kDefault), seed);
    table.come_to_rest();
    REQUIRE(table.estimate().resting);
    CHECK(table.error_px() < 1);
    for (int i = 0; i < 10; ++i) {
      table.approach({0, -70.0 + 5 * i}, {0, 500}, 10);
      CHECK(table.estimate().state == TrackState::kTracking);
      CHECK(table.error_px() < 1.5);
    }
    table.glide({0, 1500}, 2);
    CHECK(table.error_px() < 2);
  }
}

// Whether a puck that comes to rest before a noisy sensor, 3 Hz a pixel, is tracked all the while.
bool rests_in_noise(const PipelineParams& params, std::uint32_t seed) {
  Table table(params, seed);
  table.noise_a_ms = 230;
  table.come_to_rest();
  for (int i = 0; i < 100; ++i) {
    table.rest(10);
    if (table.estimate().state != TrackState::kTracking || table.error_px() > 1.5) return false;
  }
  return table.estimate().resting;
}

TEST_CASE("a puck at rest is not lost in the sensor's noise") {
  PipelineParams without = preset_params(Preset::kDefault);
  without.contour.ingredients.noise_floor = false;
  for (std::uint32_t seed = 1; seed <= std::min(kSeeds, 2u); ++seed) {
    CAPTURE(seed);
    CHECK(rests_in_noise(preset_params(Preset::kDefault), seed));
    CHECK_FALSE(rests_in_noise(without, seed));
  }
}

TEST_CASE("a puck that is covered at rest is lost, or stays where it is") {
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    CAPTURE(seed);
    Table table(preset_params(Preset::kDefault), seed);
    table.come_to_rest();
    REQUIRE(table.estimate().resting);
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
    Table table(preset_params(Preset::kDefault), seed);
    table.come_to_rest();
    for (int i = 0; i < 60; ++i) {
      table.approach({0, -26}, {0, 200}, 10);
      table.approach({0, -24}, {0, -200}, 10);
      table.rest(30, 3);
    }
    CHECK(table.estimate().state == TrackState::kTracking);
    CHECK(table.error_px() < 1.5);
  }
}

// How far off the track of a puck at rest is at worst while a mallet comes down to it and draws
// back for 60 ms; 100 if it is lost.
double worst_px_beside_mallet(const PipelineParams& params, double beside_px, int down_ms,
                              PixelVelocity back, std::uint32_t seed) {
  Table table(params, seed);
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

TEST_CASE("a mallet that touches a puck at rest and draws back does not take the track with it") {
  PipelineParams without = preset_params(Preset::kDefault);
  without.contour.ingredients.left_behind = false;
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
      const auto worst_px = [&](const PipelineParams& params) {
        return worst_px_beside_mallet(params, scene.beside_px, scene.down_ms, scene.back, seed);
      };
      CHECK(worst_px(preset_params(Preset::kDefault)) < 1.5);
      CHECK(worst_px(without) > 20);
    }
  }
}

TEST_CASE("a faint puck is followed when it sets off slowly") {
  for (std::uint32_t seed = 1; seed <= std::min(kSeeds, 2u); ++seed) {
    CAPTURE(seed);
    Table table(preset_params(Preset::kDefault), seed);
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

// Whether the track of a lost puck comes to be where searches see something go its way, without any
// events.
bool follows_searches(Table& table, PixelVelocity velocity) {
  REQUIRE(table.estimate().state == TrackState::kLost);
  table.imagine({40, 200}, velocity);
  bool was_there = false;
  for (int i = 0; i < 150; ++i) {
    table.cover(1);
    if (table.estimate().state == TrackState::kTracking && table.from_imagined_px() < 5) {
      was_there = true;
    }
  }
  return was_there;
}

constexpr double kFaintDensity = 0.6;
constexpr double kClearDensity = 3;

TEST_CASE("a faint puck that is lost is where searches have followed it, without any events") {
  const auto is_found = [](double density, bool is_on, PixelVelocity velocity) {
    PipelineParams params = preset_params(Preset::kDefault);
    params.contour.ingredients.sighting_trails = is_on;
    Table table(params);
    table.density = density;
    CHECK(table.glide({400, 60}, 300) < 1);
    table.cover(150);
    return follows_searches(table, velocity);
  };
  CHECK(is_found(kFaintDensity, true, {400, 0}));
  if (kIsSanitized) return;
  CHECK_FALSE(is_found(kFaintDensity, false, {400, 0}));
  CHECK_FALSE(is_found(kClearDensity, true, {400, 0}));
  CHECK_FALSE(is_found(kFaintDensity, true, {10, 0}));
}

TEST_CASE("a faint puck that has been lost for long is still known to be faint") {
  const auto is_found = [](double density, bool is_on, int milliseconds = 900) {
    PipelineParams params = preset_params(Preset::kDefault);
    params.contour.ingredients.faint_memory = is_on;
    Table table(params);
    table.density = density;
    for (const double speed : {400, -400, 400}) {
      CHECK(table.glide({speed, 60}, milliseconds / 3) < 1);
    }
    table.cover(1'200);
    return follows_searches(table, {400, 0});
  };
  CHECK(is_found(kFaintDensity, true));
  if (kIsSanitized) return;
  // It has not been beyond doubt for long enough.
  CHECK_FALSE(is_found(kFaintDensity, true, 450));
  CHECK_FALSE(is_found(kFaintDensity, false));
  CHECK_FALSE(is_found(kClearDensity, true));
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

TEST_CASE("all of the image is watched for what stands still as soon as a track is in doubt") {
  for (const bool is_early : {true, false}) {
    CAPTURE(is_early);
    PipelineParams params = preset_params(Preset::kDefault);
    params.contour.ingredients.early_background = is_early;
    Table table(params);
    table.glide({250, 30}, 600);
    REQUIRE(table.estimate().region != Region::all_of(kHalfSensor));
    table.cover(50);
    int watched_ms = 0;
    for (int i = 0; i < 20; ++i) {
      table.cover(1);
      if (table.estimate().region == Region::all_of(kHalfSensor)) ++watched_ms;
    }
    CAPTURE(watched_ms);
    CHECK((is_early ? watched_ms == 20 : watched_ms < 10));
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
  PipelineParams params = preset_params(Preset::kDefault);
  // Summed over how long it is away, since searches fall when they fall.
  const auto milliseconds_until_found = [&params] {
    int milliseconds = 0;
    for (const int away_ms : {14, 18, 22, 26}) {
      Table table(params);
      let_leave(table, away_ms);
      table.put({319 + 3.5 * away_ms, 200});
      // Back to where half of it is seen.
      table.glide({-3'500, 300}, away_ms + 1);
      for (; table.error_px() > 5 && milliseconds < 200; ++milliseconds) {
        table.glide({-3'500, 300}, 1);
      }
    }
    return milliseconds;
  };
  const int with_ms = milliseconds_until_found();
  params.contour.ingredients.way_back = false;
  const int without_ms = milliseconds_until_found();
  CAPTURE(with_ms);
  CAPTURE(without_ms);
  CHECK(with_ms < 60);
  CHECK(without_ms > with_ms + 10);
}

TEST_CASE("a slow puck is sooner believed near where one has left than far from there") {
  const auto milliseconds_until_taken = [](Pixel start) {
    Table table;
    let_leave(table, 14);
    table.put(start);
    // It has few events, and searches do not find it evident.
    table.density = 0.5;
    table.imagine(start, {-450, 0});
    int milliseconds = 0;
    for (; table.error_px() > 5 && milliseconds < 100; ++milliseconds) table.glide({-450, 0}, 1);
    return milliseconds;
  };
  const int near_ms = milliseconds_until_taken({300, 160});
  const int far_ms = milliseconds_until_taken({160, 160});
  CAPTURE(near_ms);
  CAPTURE(far_ms);
  CHECK(near_ms < 30);
  CHECK(far_ms > near_ms + 30);
}

TEST_CASE("random events are never a puck") {
  Table table;
  table.cover(300);
  table.rest(100);
  CHECK(table.estimate().state == TrackState::kSearching);
}

TEST_CASE("the search looks for the side wall that a track beyond doubt has shown") {
  for (const bool is_other : {false, true}) {
    CAPTURE(is_other);
    Table table;
    if (is_other) table.show_other_wall();
    CHECK(table.glide({700, 200}, 300) < 0.2);
    table.searches();
    table.cover(100);
    REQUIRE(table.estimate().state == TrackState::kLost);
    const std::string while_trusted = table.searches();
    CHECK(while_trusted == std::string(while_trusted.size(), is_other ? 'o' : 'c'));
    CHECK(while_trusted.size() > 10);
    table.cover(200);
    // SoughtWall's doubts.
    CHECK((table.searches().find("ooocoooc") != std::string::npos) == is_other);
  }
}

// Of a puck whose annotations leave its wall out.
PuckSizeModel half_face_model() {
  PuckSizeModel model = kHalfSizeModel;
  model.disc = DiscModel{.width_0 = 16,
                         .width_y = 0.08,
                         .face_on_px = 60,
                         .principal_x_px = 160,
                         .principal_y_px = 120};
  return model;
}

TEST_CASE("a puck is followed whose side wall makes events below the face that was annotated") {
  const PuckSizeModel model = half_face_model();
  REQUIRE(PuckContour(kHalfSensor, model, {0, 0, 0}, true).other_wall_share() < -0.1);
  for (const bool has_wall : {false, true}) {
    CAPTURE(has_wall);
    Table table(preset_params(Preset::kDefault), 1, model);
    if (has_wall) table.show_other_wall();
    CHECK(table.glide({700, 200}, 300) < 0.2);
    CHECK(table.estimate().state == TrackState::kTracking);
  }
}

TEST_CASE("how high a wall is that the annotations leave out is learned on the way") {
  const PuckSizeModel model = half_face_model();
  const auto error_px = [&](bool learns) {
    PipelineParams params = preset_params(Preset::kDefault);
    params.contour.ingredients.wall_height = learns;
    Table table(params, 1, model);
    table.show_wall(0.24);
    table.put({60, 60});
    table.glide({300, 200}, 500);
    return table.glide({100, 150}, 200);
  };
  const double learned_px = error_px(true);
  CHECK(learned_px < 0.4);
  CHECK(error_px(false) > 1.5 * learned_px);
}

TEST_CASE("a slow track, which may be a mallet's, shows no side wall") {
  Table table;
  CHECK(table.glide({200, 50}, 300) < 0.2);
  table.searches();
  table.cover(100);
  const std::string searches = table.searches();
  CHECK(std::abs(2 * std::ranges::count(searches, 'o') - std::ssize(searches)) <= 1);
  CHECK(searches.size() > 5);
}

TEST_CASE("before anything has been found the other side wall is looked for only after a while") {
  Table table;
  table.cover(kPatience_us / 1000);
  const std::string early = table.searches();
  CHECK(early == std::string(early.size(), 'c'));
  CHECK(early.size() > 5);
  table.cover(100);
  CHECK(table.searches() == "ocococococ");
}

TEST_CASE("without ingredient wall-search only the calibrated side wall is looked for") {
  PipelineParams params = preset_params(Preset::kDefault);
  params.contour.ingredients.wall_search = false;
  Table table(params);
  table.show_other_wall();
  CHECK(table.glide({700, 200}, 300) < 0.2);
  table.cover(300);
  const std::string searches = table.searches();
  CHECK(searches == std::string(searches.size(), 'c'));
  CHECK(searches.size() > 10);
}

TEST_CASE("searches see what is fresh only, unless fresh-search is off") {
  for (const bool is_on : {true, false}) {
    PipelineParams params = preset_params(Preset::kDefault);
    params.contour.ingredients.fresh_search = is_on;
    const auto pipeline = make_pipeline(kHalfSensor, params, kHalfSizeModel);
    // The first decision asks for a search.
    const Event late{100, 100, 0, 1'000};
    pipeline->take({0}, std::span(&late, 1));
    const SearchRequest wanted = pipeline->search_wanted();
    REQUIRE_FALSE(wanted.region.empty());
    CHECK(wanted.fresh_only == is_on);
  }
}

TEST_CASE("what a search for an unseen side wall finds moves too slowly to be believed at once") {
  const PuckContour contour(kHalfSensor, kHalfSizeModel, {0, 0, 0}, true);
  ContourPipelineParams params = preset_params(Preset::kDefault).contour;
  params.calibration = {0, 0, 0};
  for (const bool is_other : {false, true}) {
    CAPTURE(is_other);
    ContourPipeline pipeline(kHalfSensor, params, {}, kHalfSizeModel);
    std::int64_t now_us = 0;
    // Lets it glide for so long, and every search find it; how far the track is from it then.
    const auto glide = [&](Pixel start, PixelVelocity velocity, int milliseconds,
                           bool is_other_wall) {
      test::MovingContour puck(contour, start, velocity);
      const std::int64_t start_us = now_us;
      for (; now_us < start_us + milliseconds * 1000; now_us += 1000) {
        const std::int64_t from_us = now_us - start_us;
        const EventPacket packet =
            test::packet_of(puck.events(from_us, from_us + 1000), kHalfSensor, now_us, from_us);
        for_each_piece(packet.start, packet.events, pipeline.decision_period_us(),
                       [&](std::span<const Event> piece) {
                         pipeline.take(packet.start, piece);
                         const Region region = pipeline.search_wanted().region;
                         if (region.empty()) return;
                         pipeline.take({.time = packet.start,
                                        .request = {region, is_other_wall},
                                        .candidates = {{puck.position_at(from_us), 0.9}}});
                       });
      }
      const PuckEstimate estimate = pipeline.step({.newest_event = {now_us}});
      REQUIRE(estimate.position.has_value());
      return distance_px(*estimate.position, puck.position_at(now_us - start_us));
    };
    // Not fast enough to show its wall.
    CHECK(glide({60, 60}, {250, 30}, 150, false) < 0.5);
    CHECK((glide({200, 180}, {80, 10}, 50, is_other) > 100) == is_other);
  }
}

TEST_CASE("the same events give the same estimates, however often one asks") {
  const auto run = [](int asks) {
    SurfaceTracker tracker(kHalfSensor, preset_params(Preset::kDefault), kHalfSizeModel);
    const PuckContour contour(kHalfSensor, kHalfSizeModel, {}, true);
    test::MovingContour puck(contour, {60, 100}, {700, 200});
    PuckEstimate last;
    for (int i = 0; i < 100; ++i) {
      const std::int64_t from_us = i * 1000;
      const EventPacket packet =
          test::packet_of(puck.events(from_us, from_us + 1000), kHalfSensor, from_us, from_us);
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

TEST_CASE("every ingredient can be left out") {
  constexpr int kMs = kIsSanitized ? 60 : 150;
  for (const ContourIngredient& ingredient : kContourIngredients) {
    CAPTURE(std::string(ingredient.name));
    PipelineParams params = preset_params(Preset::kDefault);
    params.contour.ingredients.*ingredient.is_on = false;
    Table table(params);
    CHECK(table.glide({700, 200}, kMs) < 1);
  }
}

}  // namespace
}  // namespace puck
