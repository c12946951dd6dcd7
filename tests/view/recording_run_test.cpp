#include "tools/view/recording/recording_run.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/contains.h"
#include "tests/view/disc_recording.h"
#include "tools/evaluate/runs.h"
#include "tools/view/recording/rate_scan.h"

namespace puck {
namespace {

using test::disc_at;
using test::DiscRecording;
using Progress = RecordingRun::Progress;

RecordingOptions options_of(const DiscRecording& disc) {
  RecordingOptions options;
  options.recording = disc.path();
  return options;
}

void advance(RecordingRun& run, std::int64_t until_us) {
  while (run.now().us < until_us && run.step({until_us}) == Progress::kAdvanced) continue;
}

ViewScene scene_of(const RecordingRun& run, const PictureWishes& wishes = {}) {
  ViewScene scene;
  run.fill(wishes, scene);
  return scene;
}

bool equal(const PuckEstimate& a, const PuckEstimate& b) {
  return a.state == b.state && a.position == b.position && a.score == b.score &&
         a.velocity.x == b.velocity.x && a.covariance == b.covariance &&
         a.newest_event == b.newest_event;
}

TEST_CASE("a tracker says the same as in puck-evaluate, whenever pictures are taken") {
  const DiscRecording disc;
  const OpenedRecording recording(options_of(disc));
  std::vector<std::pair<Timestamp, PuckEstimate>> expected;
  const auto events = recording.open_events();
  run_at_rate(*events, *recording.setup_of("default"), 1000,
              [&](const EvaluatedTick& tick) { expected.emplace_back(tick.tick, tick.estimate); });

  RecordingRun run(recording);
  run.choose(0, "default");
  run.start(recording.first());
  int tracked = 0;
  // Pictures between the ticks.
  std::int64_t picture_us = run.now().us;
  for (const auto& [tick, estimate] : expected) {
    for (; picture_us < tick.us; picture_us += 370) advance(run, picture_us);
    advance(run, tick.us);
    const ViewScene scene = scene_of(run);
    REQUIRE(scene.tracks[0].estimate);
    CHECK(equal(*scene.tracks[0].estimate, estimate));
    if (estimate.state == TrackState::kTracking) ++tracked;
  }
  CHECK(tracked > 300);
}

TEST_CASE("after a start at a time the same is seen, whatever was played before") {
  const DiscRecording disc;
  const OpenedRecording recording(options_of(disc));
  RecordingRun run(recording);
  run.choose(0, "correlation");
  run.choose(1, "cluster");
  run.start({1'400'000});
  advance(run, 1'400'000);
  const ViewScene first = scene_of(run);
  advance(run, 1'900'000);
  run.start({1'200'000});
  advance(run, 1'300'000);
  run.start({1'400'000});
  advance(run, 1'400'000);
  const ViewScene again = scene_of(run);
  for (const std::size_t side : {0u, 1u}) {
    REQUIRE(first.tracks[side].estimate);
    CHECK(equal(*first.tracks[side].estimate, *again.tracks[side].estimate));
    CHECK(first.tracks[side].trail.size() == again.tracks[side].trail.size());
  }
  for (int y = 0; y < first.sensor.height; ++y) {
    CHECK(std::equal(first.events.row(y), first.events.row(y) + first.sensor.width,
                     again.events.row(y)));
  }
}

TEST_CASE("the puck is found, compared with truth, and its loss noted") {
  const DiscRecording disc;
  const OpenedRecording recording(options_of(disc));
  RecordingRun run(recording);
  run.choose(0, "correlation");
  run.start(recording.first());
  advance(run, 1'350'000);
  const SideRun& side = run.side(0);
  REQUIRE(side.error_px());
  CHECK(*side.error_px() < 2);
  CHECK(side.is_lost() == false);
  REQUIRE(scene_of(run).truth);
  CHECK(scene_of(run).truth->centre.x == doctest::Approx(disc_at(1'350'000).x));
  CHECK(run.samples().back().events_per_s > 0);
  while (run.step({2'000'000}) != Progress::kEnded) continue;
  // The first loss is before the detection.
  const auto loss = run.losses(0).after({1'300'000});
  REQUIRE(loss);
  CHECK(loss->begin >= Timestamp{test::kGapBegin_us});
  CHECK(loss->begin < Timestamp{test::kGapEnd_us});
  CHECK(run.examined(0).end_around({1'300'000}) >= Timestamp{1'890'000});
}

TEST_CASE("the surface and the heat map are those of the moment") {
  const DiscRecording disc;
  const OpenedRecording recording(options_of(disc));
  RecordingRun run(recording);
  CHECK(run.keep_surface(0));
  CHECK(!run.keep_surface(0));
  run.start({1'400'000});
  advance(run, 1'400'000);
  PictureWishes wishes;
  wishes.backdrop = PictureWishes::Backdrop::kSurface;
  const ViewScene scene = scene_of(run, wishes);
  CHECK(scene.no_backdrop.empty());
  const Pixel puck = disc_at(1'400'000);
  const auto bright = [&](int x, int y) { return scene.surface(x, y) > 100; };
  int edge = 0;
  for (int y = 52; y <= 68; ++y) {
    for (int x = 7; x <= 12; ++x) edge += bright(static_cast<int>(puck.x) + x, y) ? 1 : 0;
  }
  CHECK(edge > 4);
  CHECK(!bright(150, 100));
}

TEST_CASE("what is missing beside a recording is told, and its events can still be seen") {
  const TemporaryFolder folder;
  const DiscRecording disc;
  std::filesystem::copy(disc.path(), folder / "alone.raw");
  RecordingOptions options;
  options.recording = folder / "alone.raw";
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const OpenedRecording recording(options);
  std::filesystem::current_path(before);
  CHECK(recording.size_model() == nullptr);
  CHECK(recording.trackers().empty());
  CHECK(contains(recording.no_size_model(), "--size-model"));
  CHECK(contains(recording.no_table(), "--table"));
  REQUIRE(recording.messages().size() == 1);
  CHECK(contains(recording.messages()[0].text, "puck-calibrate size"));
  RecordingRun run(recording);
  CHECK_THROWS_AS(run.choose(0, "default"), std::invalid_argument);
  advance(run, 1'200'000);
  PictureWishes wishes;
  wishes.backdrop = PictureWishes::Backdrop::kHeatMap;
  CHECK(contains(scene_of(run, wishes).no_backdrop, "--size-model"));
  wishes.view = PictureWishes::View::kTable;
  CHECK(contains(scene_of(run, wishes).no_table, "--table"));
}

TEST_CASE("a size model of another sensor is doubted in words") {
  const DiscRecording disc;
  RecordingOptions options = options_of(disc);
  options.size_model = disc.folder().write(
      "other.toml",
      "[size_model]\nwidth_0 = 20.0\nwidth_x = 0.0\nwidth_y = 0.0\nheight_0 = 16.0\n"
      "height_x = 0.0\nheight_y = 0.0\n[size_range]\nsensor_width = 640\nsensor_height = 480\n");
  const OpenedRecording recording(options);
  REQUIRE(!recording.messages().empty());
  CHECK(contains(recording.messages()[0].text, "640"));
}

TEST_CASE("a tracker that does not exist is answered with those that do") {
  const DiscRecording disc;
  const OpenedRecording recording(options_of(disc));
  RecordingRun run(recording);
  CHECK_THROWS_WITH_AS(run.choose(0, "best"),
                       "there is no tracker called best: choose off or one of default correlation "
                       "paper reference cluster particle-filter particle-filter-eros",
                       std::invalid_argument);
}

TEST_CASE("the time line counts every event, in few bins however long the recording is") {
  const TemporaryFolder folder;
  const auto writer = make_event_writer(folder / "long.csv", "", {32, 24});
  constexpr int kEvents = 5000;
  for (int i = 0; i < kEvents; ++i) {
    EventPacket packet{{std::int64_t{i} * 100'000}, {}};
    packet.events.resize(1);
    writer->write(packet);
  }
  writer->close();
  EventFileOptions options;
  options.sensor = {32, 24};
  options.text_unit = "us";
  const RateScan scan(open_event_file(folder / "long.csv", options));
  ViewTimeline timeline;
  do scan.fill(timeline);
  while (!timeline.is_complete);
  CHECK(timeline.events.size() <= RateScan::kMostBins);
  std::int64_t counted = 0;
  for (const std::int64_t events : timeline.events) counted += events;
  CHECK(counted == kEvents);
  CHECK(timeline.first == Timestamp{0});
  CHECK(timeline.last == Timestamp{(kEvents - 1) * 100'000});
  CHECK(scan.warnings().empty());
}

}  // namespace
}  // namespace puck
