// Preset default on recordings of real cameras: some without a puck, one with an ellipse.
#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/evaluation/truth_track.h"
#include "common/io/event_reader.h"
#include "common/io/truth_file.h"
#include "tests/support/recordings.h"
#include "tests/support/sanitizers.h"
#include "tools/evaluate/runs.h"

namespace puck {
namespace {

struct Recording {
  std::string file;
  EventFileOptions options;
  int ticks = 0;  // Milliseconds, so that an empty run is noticed.
};

const std::vector<Recording> kWithoutPuck{
    {"dynamic_translation_davis240c_240x180.txt", {.sensor = {240, 180}}, 40},
    {"driving_gen41_1280x720_evt3.raw", {}, 10},
    {"sparklers_gen31_640x480_evt2.raw", {}, 97},
    {"walking_640x480_evt3.extracted.raw", {.sensor = {640, 480}}, 2080},
};

// One for the table, and those of a puck at the far end, in the middle and near by.
std::vector<PuckSizeModel> size_models() {
  std::vector<PuckSizeModel> models;
  PuckSizeModel& table = models.emplace_back();
  table.width_0 = 16;
  table.width_y = 0.072;
  table.height_0 = 6;
  table.height_y = 0.071;
  table.smallest = {9, 4};
  table.largest = {80, 61};
  for (const double width : {16.0, 32.0, 48.0}) {
    PuckSizeModel model;
    model.width_0 = width;
    model.height_0 = 0.75 * width;
    models.push_back(model);
  }
  return models;
}

TEST_CASE("no puck is confirmed in recordings of a desk, a street, sparks and a person") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  const std::vector<PuckSizeModel> models = size_models();
  for (const Recording& recording : kWithoutPuck) {
    // Under a sanitizer a long one runs with one model only.
    const bool all = !kIsSanitized || recording.ticks < 100;
    for (const PuckSizeModel& model : std::span(models).first(all ? models.size() : 1)) {
      CAPTURE(recording.file);
      CAPTURE(model.width_0);
      TrackerSetup setup;
      setup.size_model = model;
      const auto events = open_event_file(*recordings / recording.file, recording.options);
      int ticks = 0;
      int confirmed = 0;
      run_at_rate(*events, setup, 1000, [&](const EvaluatedTick& tick) {
        ++ticks;
        if (tick.estimate.state == TrackState::kTracking) ++confirmed;
      });
      CHECK(ticks == recording.ticks);
      CHECK(confirmed == 0);
    }
  }
}

struct Followed {
  int ticks = 0;
  int tracked = 0;
  double mean_px = 0;
  double worst_px = 0;
};

// The ellipse with a size and a lean given by hand.
Followed follow_ellipse(const std::filesystem::path& recordings) {
  const std::string name = "shapes_rotation_davis240c_240x180";
  const TruthTrack truth(read_truth_file(recordings / (name + ".truth.csv")));
  TrackerSetup setup;
  setup.size_model.width_0 = 33;
  setup.size_model.height_0 = 23;
  setup.contour.lean_deg = -28;
  const auto events =
      open_event_file(recordings / (name + ".txt"), EventFileOptions{.sensor = {240, 180}});
  Followed followed;
  double sum_px = 0;
  run_at_rate(*events, setup, 1000, [&](const EvaluatedTick& tick) {
    const auto true_puck = truth.at(tick.tick);
    if (!true_puck) return;
    ++followed.ticks;
    if (tick.estimate.state != TrackState::kTracking) return;
    ++followed.tracked;
    const double error_px = distance_px(*tick.estimate.position, true_puck->centre);
    sum_px += error_px;
    followed.worst_px = std::max(followed.worst_px, error_px);
  });
  followed.mean_px = sum_px / followed.tracked;
  MESSAGE("the ellipse: tracked in ", followed.tracked, " of ", followed.ticks, " ms, ",
          followed.mean_px, " px off, at most ", followed.worst_px);
  return followed;
}

TEST_CASE("the ellipse among other shapes is tracked with a given size and lean") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  const Followed ellipse = follow_ellipse(*recordings);
  CHECK(ellipse.ticks == 93);
  // From the start, except for the first 10 ms.
  CHECK(ellipse.tracked > 80);
  CHECK(ellipse.mean_px < 1.5);
  CHECK(ellipse.worst_px < 2.5);
}

}  // namespace
}  // namespace puck
