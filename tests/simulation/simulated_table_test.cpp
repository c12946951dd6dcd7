#include "common/simulation/simulated_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/simulation/camera_view.h"
#include "common/simulation/head_motion.h"
#include "common/simulation/table_game.h"
#include "common/simulation/world_view.h"
#include "tests/simulation/test_worlds.h"

namespace puck {
namespace {

EventPacket play(SimulatedTable& table, double seconds) {
  EventPacket packet;
  while (static_cast<double>(table.now().us) < seconds * 1e6) table.advance(packet);
  return packet;
}

bool same(const EventPacket& a, const EventPacket& b) {
  return a.start == b.start && a.events == b.events;
}

}  // namespace

TEST_CASE("The same seed gives the same events, to the bit; another seed gives others") {
  for (const bool moving : {false, true}) {
    SimulationParams params = small_world(4);
    params.moving_camera = moving;
    SimulatedTable one(params);
    SimulatedTable other(params);
    params.seed = 5;
    SimulatedTable another(params);
    const EventPacket events = play(one, 0.4);
    CHECK(events.events.size() > 1000);
    CHECK(same(events, play(other, 0.4)));
    CHECK_FALSE(same(events, play(another, 0.4)));
  }
}

TEST_CASE("Events are in the order of their times, each in its slice and on the sensor") {
  for (const bool moving : {false, true}) {
    SimulationParams params = small_world();
    params.moving_camera = moving;
    SimulatedTable table(params);
    Timestamp before{0};
    bool ordered = true;
    bool inside = true;
    for (int i = 0; i < 600; ++i) {
      const Timestamp start = table.now();
      EventPacket packet;
      table.advance(packet);
      CHECK(table.now() - start == params.slice_us);
      for (const Event& event : packet.events) {
        const Timestamp t = packet.time_of(event);
        ordered &= t >= before && t >= start && t < table.now();
        inside &= table.sensor_size().contains(event.x, event.y);
        before = t;
      }
    }
    CHECK(ordered);
    CHECK(inside);
  }
}

TEST_CASE("Event rates are those of the real camera, and higher for a moving one") {
  SimulationParams params = small_world();
  params.sensor_size = {640, 480};
  params.camera.focal_px = CameraParams{}.focal_px;
  SimulatedTable still(params);
  const double still_hz = static_cast<double>(play(still, 2).events.size()) / 2;
  CHECK(still_hz > 50e3);
  CHECK(still_hz < 300e3);
  params.moving_camera = true;
  SimulatedTable moving(params);
  const double moving_hz = static_cast<double>(play(moving, 0.5).events.size()) / 0.5;
  CHECK(moving_hz > 0.8e6);
  CHECK(moving_hz < 5e6);
  CHECK(moving_hz > 2 * still_hz);
}

TEST_CASE("Truth in the image agrees with truth on the table through the homography") {
  SimulatedTable table(small_world());
  const Homography table_from_image = table.table_from_image();
  int checked = 0;
  EventPacket packet;
  for (int i = 0; i < 6000; ++i) {
    packet.events.clear();
    table.advance(packet);
    const SimulatedTruth truth = table.truth();
    if (i % 50 != 0 || !truth.in_play) continue;
    ++checked;
    const auto place = table_from_image.to_table(truth.position_px);
    REQUIRE(place);
    // The silhouette's middle is the centre's image, except for the perspective within the puck.
    CHECK(std::hypot(place->x_m - truth.position.x_m, place->y_m - truth.position.y_m) < 0.004);
  }
  CHECK(checked > 60);
}

TEST_CASE("The puck is drawn at its true place") {
  SimulatedTable table(small_world());
  EventPacket packet;
  int checked = 0;
  while (table.now().us < 4'000'000) {
    packet.events.clear();
    table.advance(packet);
    const SimulatedTruth truth = table.truth();
    if (table.now().us % 100'000 != 0 || truth.visible < 1 || truth.position.x_m > 1.5) continue;
    ++checked;
    const Image<float> image = table.log_intensity();
    const float dark = std::log(static_cast<float>(SceneParams{}.puck_luminance));
    const auto light_at = [&](double dx, double dy) {
      return image(static_cast<int>(std::lround(truth.position_px.x + dx * truth.size_px.width)),
                   static_cast<int>(std::lround(truth.position_px.y + dy * truth.size_px.height)));
    };
    CHECK(light_at(0, 0) == doctest::Approx(dark).epsilon(0.001));
    CHECK(light_at(0.35, 0) == doctest::Approx(dark).epsilon(0.001));
    CHECK(light_at(-0.35, 0) == doctest::Approx(dark).epsilon(0.001));
    CHECK(light_at(0.65, 0) > dark + 0.2f);
    CHECK(light_at(-0.65, 0) > dark + 0.2f);
  }
  CHECK(checked > 5);
}

TEST_CASE("A moving camera draws the picture of its pose") {
  SimulationParams params = small_world();
  params.moving_camera = true;
  SimulatedTable table(params);
  play(table, 0.3);
  const SimulatedTruth truth = table.truth();
  CHECK(std::abs(truth.head.yaw_deg) < 3.2);
  const CameraView home(params.camera, params.sensor_size);
  const CameraView view = home.turned(truth.head);
  const Image<float> image = table.log_intensity();
  // A quarter of the way along the centre line, and the table beside it.
  const Pixel line = view.project({2.135 / 2, 0.3, 0})->pixel;
  const auto light_at = [&](double x, double y) {
    return image(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)));
  };
  const float bright = std::log(static_cast<float>(SceneParams{}.table_luminance));
  CHECK(light_at(line.x, line.y) < bright - 0.1f);
  CHECK(light_at(line.x, line.y + 6) == doctest::Approx(bright).epsilon(0.001));
  CHECK(light_at(line.x, line.y - 6) == doctest::Approx(bright).epsilon(0.001));
}

TEST_CASE("A moving puck's events lie along its contour") {
  SimulationParams params = small_world();
  params.sensor.noise_hz = 0;
  params.sensor.hot_pixel_fraction = 0;
  SimulatedTable table(params);
  int near = 0;
  int all = 0;
  while (table.now().us < 3'000'000) {
    EventPacket packet;
    table.advance(packet);
    const SimulatedTruth truth = table.truth();
    const double speed = std::hypot(truth.velocity.x_m_s, truth.velocity.y_m_s);
    if (truth.visible < 1 || speed < 1 || truth.position.x_m > 1.4 || truth.position.x_m < 0.5) {
      continue;
    }
    for (const Event& event : packet.events) {
      const double dx = (event.x - truth.position_px.x) / (truth.size_px.width / 2);
      const double dy = (event.y - truth.position_px.y) / (truth.size_px.height / 2);
      const double radius = std::hypot(dx, dy);
      if (radius > 2) continue;
      ++all;
      near += radius > 0.5 && radius < 1.5;
    }
  }
  CHECK(all > 1000);
  CHECK(near > 0.95 * all);
}

TEST_CASE("The robot's mallet follows the arm, stays on its line, and ignores impossible values") {
  SimulationParams params = small_world();
  params.autonomous_robot = false;
  SimulatedTable table(params);
  table.set_robot_mallet(0.2);
  play(table, 0.1);
  CHECK(table.truth().robot_mallet.y_m == doctest::Approx(0.2).epsilon(0.001));
  table.set_robot_mallet(std::nan(""));
  play(table, 0.2);
  CHECK(table.truth().robot_mallet.y_m == doctest::Approx(0.2).epsilon(0.001));
  table.set_robot_mallet(5);
  play(table, 0.4);
  CHECK(table.truth().robot_mallet.y_m == doctest::Approx(0.3).epsilon(0.001));
  CHECK(table.truth().robot_mallet.x_m == 0.15);
}

TEST_CASE("The robot's mallet hides a puck behind it in part") {
  SimulationParams params;
  TableGame game(params);
  const WorldView world(params.table, params.scene, params.sensor_size);
  const CameraView view(params.camera, params.sensor_size);
  game.place_puck({{1, 0}, {0, 0}});
  CHECK(world.visible_share(game, view) == doctest::Approx(1));
  game.place_puck({{0.235, 0}, {0, 0}});
  CHECK(world.visible_share(game, view) < 0.95);
  // At the left border of the image: half of it is inside.
  const Homography table_from_image = view.table_from_image(0.006);
  const auto border = table_from_image.to_table({-0.5, 400});
  REQUIRE(border);
  game.place_puck({*border, {0, 0}});
  CHECK(world.visible_share(game, view) == doctest::Approx(0.5).epsilon(0.2));
}

TEST_CASE("An arm hides objects beneath it, even nearer than its mallet") {
  const SimulationParams params;
  TableGame game(params);
  const WorldView world(params.table, params.scene, params.sensor_size);
  const CameraView view(params.camera, params.sensor_size);
  const TablePoint mallet = game.robot_mallet().position;
  double least = 1;
  for (double y_m = -0.15; y_m <= 0; y_m += 0.01) {
    game.place_puck({{mallet.x_m - 0.09, mallet.y_m + y_m}, {0, 0}});
    least = std::min(least, world.visible_share(game, view));
  }
  CHECK(least < 0.2);
  // The mallet, which stands on the table, is behind such a puck.
  const std::vector<int> order = WorldView::nearest_first(game);
  const auto place_of = [&](WorldView::Body body) {
    return std::find(order.begin(), order.end(), body) - order.begin();
  };
  CHECK(place_of(WorldView::kRobotArm) < place_of(WorldView::kPuck));
  CHECK(place_of(WorldView::kPuck) < place_of(WorldView::kRobot));
}

TEST_CASE("The puck is visible on nearly all of the table, in the sizes of the references") {
  const SimulationParams params;
  const WorldView world(params.table, params.scene, params.sensor_size);
  const CameraView view(params.camera, params.sensor_size);
  const PixelBox far = world.puck_box({2.1, 0}, view);
  const PixelBox near = world.puck_box({0.1, 0}, view);
  CHECK(far.size.width == doctest::Approx(17.4).epsilon(0.03));
  CHECK(far.size.height == doctest::Approx(8.2).epsilon(0.03));
  CHECK(near.size.width == doctest::Approx(45).epsilon(0.05));
  CHECK(near.size.height == doctest::Approx(39).epsilon(0.1));
  int seen = 0;
  int all = 0;
  for (double x_m = 0.04; x_m < 2.1; x_m += 0.05) {
    for (double y_m = -0.57; y_m <= 0.571; y_m += 0.05) {
      const Pixel centre = world.puck_box({x_m, y_m}, view).centre;
      ++all;
      seen += centre.x >= 0 && centre.x < 640 && centre.y >= 0 && centre.y < 480;
    }
  }
  CHECK(seen > 0.95 * all);
}

TEST_CASE("The defaults are the paper's table, puck and moving head") {
  const SimulationParams params;
  CHECK(params.table.length_m == 2.135);
  CHECK(params.table.width_m == 1.22);
  CHECK(2 * params.table.puck_radius_m == 0.065);
  CHECK(params.camera.behind_m == 0.68);
  const HeadMotion motion(params.head_motion, Random(1, 0));
  double lowest_deg = 0;
  double highest_deg = 0;
  for (double t_s = 0; t_s < 30; t_s += 0.01) {
    lowest_deg = std::min(lowest_deg, motion.pose_at(t_s).yaw_deg);
    highest_deg = std::max(highest_deg, motion.pose_at(t_s).yaw_deg);
  }
  CHECK(highest_deg - lowest_deg > 5);
  CHECK(highest_deg - lowest_deg < 6.3);
}

TEST_CASE("Impossible parameters are refused by name") {
  const auto message_of = [](const SimulationParams& params) {
    try {
      SimulatedTable table(params);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  SimulationParams params = small_world();
  params.camera.focal_px = -1;
  CHECK(message_of(params) == "camera.focal_px must be between 50 and 5000, got -1");
  params = small_world();
  params.slice_us = 510;
  CHECK(message_of(params) == "world.slice_us must be a multiple of 25, got 510");
  params = small_world();
  params.sensor.threshold = std::nan("");
  CHECK(message_of(params) == "sensor.threshold must be between 0.02 and 2, got nan");
  params = small_world();
  params.game.shot_speed_min_m_s = 5;
  CHECK(message_of(params) ==
        "game.shot_speed_min_m_s must not be more than game.shot_speed_max_m_s");
}

}  // namespace puck
