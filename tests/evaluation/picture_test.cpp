#include "tools/evaluate/picture.h"

#include <filesystem>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>
#include <opencv2/imgcodecs.hpp>

#include "tests/evaluation/listed_events.h"
#include "tests/support/child_process.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"
#include "tools/evaluate/picture_taker.h"

namespace puck {
namespace {

// Too small a sensor for a close-up, which would cover the rest.
constexpr SensorSize kSmall{64, 48};
constexpr Timestamp kNow{1'000'000};
// The script's: rows above the sensor's image, and the least width.
constexpr int kHeaderPx = 48;
constexpr int kWidthPx = 1200;

int scale_of(SensorSize sensor) { return (kWidthPx + sensor.width - 1) / sensor.width; }

cv::Mat draw(const TrackedMoment& moment) {
  const TemporaryFolder folder;
  write_moment(moment, folder / "moment.json");
  const Finished script =
      run_program({program_path("charts/picture.py"), folder / "moment.json", folder / "puck.png"});
  REQUIRE_MESSAGE(script.exit_code == 0, script.errors);
  return cv::imread((folder / "puck.png").string());
}

TrackedMoment empty_moment(SensorSize sensor = kSmall) {
  TrackedMoment moment;
  moment.sensor = sensor;
  moment.time = kNow;
  moment.events.start = kNow - TrackedMoment::kTrailUs;
  return moment;
}

void add_event(TrackedMoment& moment, std::uint16_t x, std::uint16_t y, int polarity,
               std::int64_t age_us) {
  Event event;
  event.x = x;
  event.y = y & 0x7fff;
  event.polarity = polarity & 1;
  event.offset_us = static_cast<std::uint32_t>(moment.time - age_us - moment.events.start);
  moment.events.events.push_back(event);
}

PuckEstimate tracked_at(Pixel position) {
  PuckEstimate estimate;
  estimate.state = TrackState::kTracking;
  estimate.position = position;
  estimate.size = {12, 10};
  return estimate;
}

// The colour at a place of the sensor.
cv::Vec3b at(const cv::Mat& picture, double x, double y, SensorSize sensor = kSmall) {
  const int scale = scale_of(sensor);
  return picture.at<cv::Vec3b>(kHeaderPx + static_cast<int>((y + 0.5) * scale),
                               static_cast<int>((x + 0.5) * scale));
}
int brightness(cv::Vec3b colour) { return colour[0] + colour[1] + colour[2]; }
bool is_white(cv::Vec3b colour) { return brightness(colour) > 3 * 220; }
bool is_background(cv::Vec3b colour) { return brightness(colour) < 3 * 30; }
bool is_green(cv::Vec3b c) { return c[1] > c[0] + 20 && c[1] > c[2] + 20; }
bool is_pink(cv::Vec3b c) { return c[2] > c[1] + 50 && c[0] > c[1] + 50; }

std::string refusal(const PictureTaker& taker, EventReader& events, const RunSummary& run) {
  try {
    (void)taker.moment(events, run, nullptr);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

EvaluatedTick tick_at(std::int64_t t_us, double speed_px_s) {
  EvaluatedTick tick{{t_us}, tracked_at({20, 20}), std::nullopt};
  tick.estimate.velocity = {speed_px_s, 0};
  return tick;
}

}  // namespace

TEST_CASE("a picture is a multiple of the sensor's size, and large enough for its text") {
  for (const SensorSize sensor : {SensorSize{64, 48}, {346, 260}, {640, 480}, {1280, 720}}) {
    const cv::Mat picture = draw(empty_moment(sensor));
    CHECK(picture.cols >= 640);
    CHECK(picture.cols == sensor.width * scale_of(sensor));
    CHECK(picture.rows > sensor.height * scale_of(sensor) + kHeaderPx);
  }
}

TEST_CASE("a picture shows events by polarity, older ones fainter, and no future ones") {
  TrackedMoment moment = empty_moment();
  add_event(moment, 3, 4, 1, TrackedMoment::kEventsUs);
  add_event(moment, 5, 6, 1, 15'000);
  add_event(moment, 60, 47, 1, 0);
  add_event(moment, 9, 10, 0, 0);
  add_event(moment, 20, 20, 1, -1);
  const cv::Mat picture = draw(moment);
  const cv::Vec3b brighter = at(picture, 60, 47);
  const cv::Vec3b darker = at(picture, 9, 10);
  CHECK(brighter[2] > brighter[0] + 100);  // Orange …
  CHECK(darker[0] > darker[2] + 100);      // … and blue.
  CHECK(brightness(at(picture, 5, 6)) < brightness(brighter));
  CHECK_FALSE(is_background(at(picture, 5, 6)));
  CHECK(is_background(at(picture, 3, 4)));
  CHECK(is_background(at(picture, 20, 20)));
  CHECK(is_background(at(picture, 10, 10)));
}

TEST_CASE("a picture shows the estimate's ellipse now and in 50 ms") {
  TrackedMoment moment = empty_moment();
  moment.estimate = tracked_at({30, 20});
  moment.estimate.velocity = {400, 0};
  const cv::Mat picture = draw(moment);
  for (const Pixel on : {Pixel{36, 20}, {24, 20}, {30, 25}, {30, 15}}) {
    CHECK(is_white(at(picture, on.x, on.y)));
  }
  CHECK(is_background(at(picture, 30, 23)));
  CHECK(is_background(at(picture, 30, 27)));
  CHECK(is_white(at(picture, 40, 20)));
  CHECK(is_white(at(picture, 49.9, 20)));
  CHECK(is_background(at(picture, 51, 20)));
}

TEST_CASE("a picture shows the true ellipse only where truth is known") {
  TrackedMoment moment = empty_moment();
  CHECK(is_background(at(draw(moment), 16, 20)));
  moment.truth = TruthRow{kNow, {10, 20}, {12, 10}, 1};
  CHECK(is_pink(at(draw(moment), 16, 20)));
}

TEST_CASE("a picture shows the trail of half a second, interrupted where the puck was lost") {
  TrackedMoment moment = empty_moment();
  const auto add = [&](std::int64_t age_us, std::optional<Pixel> position) {
    moment.trail.push_back({kNow - age_us, position});
  };
  add(TrackedMoment::kTrailUs + 2'000, Pixel{2, 40});
  add(TrackedMoment::kTrailUs + 1'000, Pixel{8, 40});
  add(40'000, Pixel{10, 40});
  add(30'000, Pixel{20, 40});
  add(20'000, std::nullopt);
  add(10'000, Pixel{40, 40});
  add(0, Pixel{50, 40});
  const cv::Mat picture = draw(moment);
  CHECK(is_background(at(picture, 5, 40)));
  CHECK(is_green(at(picture, 15, 40)));
  CHECK(is_background(at(picture, 30, 40)));
  CHECK(is_green(at(picture, 45, 40)));
}

TEST_CASE("a picture of a large sensor has a close-up in the corner away from the puck") {
  constexpr SensorSize kLarge{640, 480};
  TrackedMoment moment = empty_moment(kLarge);
  const auto has_close_up = [&](double x, double y) {
    const cv::Mat picture = draw(moment);
    const cv::Rect corner(static_cast<int>(x * 2), kHeaderPx + static_cast<int>(y * 2), 240, 240);
    return cv::norm(picture(corner), cv::NORM_INF) > 200;
  };
  CHECK_FALSE(has_close_up(500, 350));
  moment.estimate = tracked_at({50, 50});
  CHECK(has_close_up(500, 350));
  moment.estimate = tracked_at({450, 300});
  CHECK_FALSE(has_close_up(500, 350));
  CHECK(has_close_up(10, 10));
}

TEST_CASE("a picture can be drawn of a puck far outside the image, and without a puck") {
  TrackedMoment moment = empty_moment();
  moment.estimate = tracked_at({1e9, -1e9});
  moment.estimate.velocity = {1e9, 1e9};
  CHECK_NOTHROW(draw(moment));
  moment.estimate = {};
  CHECK_NOTHROW(draw(moment));
}

TEST_CASE("a picture is taken at the puck's highest speed, or at a given time") {
  const TemporaryFolder folder;
  ListedEvents events({0, 5'000, 30'000});
  RunSummary run;
  run.last = {30'000};
  run.duration_s = 0.03;
  const auto moment_of = [&](std::optional<double> at_s) {
    PictureTaker taker(folder / "puck.png", at_s, events);
    for (const auto& [t_us, speed] : {std::pair(1'000, 100.0), {6'000, 300.0}, {29'000, 200.0}}) {
      taker.add(tick_at(t_us, speed));
    }
    return taker.moment(events, run, nullptr);
  };
  const TrackedMoment fastest = moment_of(std::nullopt);
  CHECK(fastest.time == Timestamp{6'000});
  CHECK(fastest.seconds == doctest::Approx(0.006));
  CHECK(fastest.trail.size() == 2);
  CHECK(fastest.events.events.size() == 2);
  CHECK(moment_of(0.006).time == fastest.time);
  // 23 ms later the first two events are forgotten, and the third is not yet there.
  CHECK(moment_of(0.0295).time == Timestamp{29'000});
  CHECK(moment_of(0.0295).events.events.empty());
}

TEST_CASE("an impossible picture is refused in one line, and nothing is written") {
  const TemporaryFolder folder;
  ListedEvents events({0, 30'000});
  RunSummary run;
  run.last = {30'000};
  run.duration_s = 0.03;
  PictureTaker late(folder / "late.png", 0.032, events);
  late.add(tick_at(1'000, 100));
  CHECK(refusal(late, events, run) ==
        "--picture-at: the recording ends before, after 0.030 s: give a time within it");
  const PictureTaker nothing(folder / "nothing.png", std::nullopt, events);
  CHECK(refusal(nothing, events, run) ==
        "--picture: the puck was never tracked: choose a time with --picture-at");
  CHECK(std::filesystem::is_empty(folder.path()));

  for (const auto& path : {folder / "no" / "folder.png", folder.path(), folder / "puck.jpg"}) {
    CHECK_THROWS_AS(PictureTaker(path, std::nullopt, events), std::runtime_error);
  }
}

}  // namespace puck
