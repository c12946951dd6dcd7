#include "common/io/lens.h"

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/config.h"
#include "common/io/event_filter.h"
#include "common/io/lens_file.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

constexpr SensorSize kPicture{64, 48};

Lens lens_of(Lens::Model model, const std::array<double, 5>& distortion) {
  return {.model = model,
          .sensor = kPicture,
          .fx_px = 50,
          .fy_px = 52,
          .cx_px = 31.5,
          .cy_px = 23.5,
          .distortion = distortion};
}

const Lens kBarrel = lens_of(Lens::Model::kPinhole, {-0.2, 0.05, 0.002, -0.001, -0.01});
const Lens kPincushion = lens_of(Lens::Model::kPinhole, {0.25, 0.03, -0.003, 0.002, 0.01});
const Lens kFisheye = lens_of(Lens::Model::kFisheye, {0.05, -0.02, 0.01, -0.003, 0});

TEST_CASE("undistorted points are those of OpenCV 4.6") {
  // undistortPoints and fisheye::undistortPoints with P = K, iterated to 1e-13.
  const std::vector<Pixel> seen{{0, 0}, {60, 5}, {31.5, 23.5}, {10, 40}, {50, 30}};
  const auto check = [&](const Lens& lens, const std::vector<Pixel>& expected) {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const std::optional<Pixel> at = lens.undistorted(seen[i]);
      REQUIRE(at);
      CHECK(at->x == doctest::Approx(expected[i].x).epsilon(1e-6));
      CHECK(at->y == doctest::Approx(expected[i].y).epsilon(1e-6));
    }
  };
  check(kBarrel, {{-4.831254, -3.735189},
                  {63.232778, 2.856935},
                  {31.5, 23.5},
                  {8.716892, 40.962412},
                  {50.610095, 30.193942}});
  check(kPincushion, {{3.492441, 2.702458},
                      {57.343673, 6.754955},
                      {31.5, 23.5},
                      {11.234468, 39.071567},
                      {49.329998, 29.790735}});
  check(kFisheye, {{-6.914714, -5.158596},
                   {64.391598, 2.149314},
                   {31.5, 23.5},
                   {8.048025, 41.498027},
                   {50.849389, 30.298434}});
}

TEST_CASE("a lens without distortion moves nothing; beyond the fold there is no point") {
  const Lens none = lens_of(Lens::Model::kPinhole, {});
  for (const Pixel at : {Pixel{0, 0}, Pixel{63, 47}, Pixel{12, 30}}) {
    REQUIRE(none.undistorted(at));
    CHECK(distance_px(*none.undistorted(at), at) < 1e-6);
  }
  // r (1 - r^2) is at most 0.385, at r = 0.577.
  const Lens folded = lens_of(Lens::Model::kPinhole, {-1, 0, 0, 0, 0});
  CHECK(folded.undistorted({31.5 + 50 * 0.38, 23.5}));
  CHECK_FALSE(folded.undistorted({31.5 + 50 * 0.39, 23.5}));
  // 90 degrees off the axis.
  const Lens equidistant = lens_of(Lens::Model::kFisheye, {});
  CHECK(equidistant.undistorted({31.5 + 50 * 1.57, 23.5}));
  CHECK_FALSE(equidistant.undistorted({31.5 + 50 * 1.58, 23.5}));
}

TEST_CASE(
    "events move to the nearest undistorted pixel; those that leave the picture are counted") {
  EventFilter filter({.lens = kBarrel}, kPicture);
  EventPacket packet = packet_of({{5, 0, 0, 1}, {6, 60, 5, 0}, {7, 10, 40, 1}, {8, 50, 30, 0}});
  filter.apply(packet);
  std::vector<PlainEvent> left;
  append_plain(packet, left);
  CHECK(left == std::vector<PlainEvent>{{6, 63, 3, 0}, {7, 9, 41, 1}, {8, 51, 30, 0}});
  CHECK(filter.left_out().outside_picture == 1);
}

TEST_CASE("the undistortion follows the turn, and its lens is of the turned picture") {
  Lens lens = kBarrel;
  lens.sensor = {48, 64};
  EventFilter together({.turn = {.rotate_deg = 90}, .lens = lens}, kPicture);
  EventFilter turn({.turn = {.rotate_deg = 90}}, kPicture);
  EventFilter undistortion({.lens = lens}, {48, 64});
  std::vector<PlainEvent> events;
  for (int i = 0; i < 64 * 48; ++i) events.push_back({i, i % 64, i / 64, i % 2});
  EventPacket at_once = packet_of(events);
  EventPacket by_steps = at_once;
  together.apply(at_once);
  turn.apply(by_steps);
  undistortion.apply(by_steps);
  CHECK(at_once.events == by_steps.events);
  CHECK(at_once.events.size() > 1000);
  CHECK(message_of<std::invalid_argument>(
            [&] { EventFilter({.lens = lens, .lens_name = "camera.undistort"}, kPicture); }) ==
        "camera.undistort is of a picture of 48 x 64 px, the events are of one of 64 x 48 px");
}

TEST_CASE("a lens file has the names of OpenCV; what is missing or of the other model is named") {
  const TemporaryFolder folder;
  const std::string camera =
      "[lens]\nwidth = 64\nheight = 48\nfx = 50\nfy = 52.0\ncx = 31.5\ncy = 23.5\n";
  const Lens lens = read_lens_file(folder.write(
      "a.toml", camera + "k1 = -0.2\nk2 = 0.05\np1 = 0.002\np2 = -0.001\nk3 = -0.01\n"));
  CHECK(lens.sensor == kPicture);
  CHECK(lens.fx_px == 50);
  CHECK(lens.cy_px == 23.5);
  CHECK(lens.distortion == kBarrel.distortion);
  const Lens fisheye = read_lens_file(folder.write(
      "b.toml", camera + "model = \"fisheye\"\nk1 = 0.05\nk2 = -0.02\nk3 = 0.01\nk4 = -0.003\n"));
  CHECK(fisheye.model == Lens::Model::kFisheye);
  CHECK(fisheye.distortion == kFisheye.distortion);

  const auto refusal = [&](const std::string& text) {
    const auto path = folder.write("c.toml", text);
    return message_of<ConfigError>([&] { read_lens_file(path); });
  };
  CHECK(contains(refusal("[lens]\nwidth = 64\n"), "c.toml: lens.height is missing"));
  CHECK(contains(refusal(camera + "k4 = 1\n"), "c.toml:8: unknown key lens.k4"));
  CHECK(contains(refusal(camera + "model = \"fisheye\"\np1 = 1\n"), "unknown key lens.p1"));
  CHECK(contains(refusal(camera + "model = \"thin\"\n"),
                 "lens.model must be \"pinhole\" or \"fisheye\", got \"thin\""));
  const std::string no_length = "[lens]\nwidth = 64\nheight = 48\nfx = 0\nfy = 1\ncx = 1\ncy = 1\n";
  CHECK(contains(refusal(no_length), "c.toml:4: lens.fx must be a number from 1 to "));
  CHECK(contains(refusal(no_length), "got 0"));
}

}  // namespace
}  // namespace puck
