#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "common/simulation/camera_view.h"
#include "common/simulation/head_motion.h"
#include "common/simulation/simulated_table.h"
#include "common/simulation/static_scene.h"
#include "common/simulation/table_game.h"
#include "common/simulation/world_view.h"
#include "tests/simulation/test_worlds.h"

namespace puck {
namespace {

SimulationParams quiet_world() {
  SimulationParams params = small_world();
  params.sensor.noise_hz = 0;
  params.sensor.hot_pixel_fraction = 0;
  return params;
}

double luminance_at(const SimulationParams& params, double x_m, double y_m) {
  return StaticScene(params.table, params.scene).luminance({x_m, y_m, 1}, {0, 0, -1});
}

}  // namespace

TEST_CASE("A puck with a side as bright as the table shows only its top") {
  SimulationParams params = small_world();
  params.scene.puck_luminance = 0.85;
  params.scene.puck_side_luminance = params.scene.table_luminance;
  const WorldView world(params.table, params.scene, params.sensor_size);
  const CameraView view(params.camera, params.sensor_size);
  TableGame game(params);
  game.place_puck({{0.5, 0}, {0, 0}});
  SimulatedTable table(params);
  // At the serve no other object is near it.
  const SimulatedTruth truth = table.truth();
  const Image<float> image = table.log_intensity();
  const auto light_at = [&](double dx_px, double dy_px) {
    return std::exp(image(static_cast<int>(std::lround(truth.position_px.x + dx_px)),
                          static_cast<int>(std::lround(truth.position_px.y + dy_px))));
  };
  CHECK(light_at(0, -1) == doctest::Approx(0.85).epsilon(0.001));
  const SceneBody body = world.body(WorldView::kPuck, game, view);
  REQUIRE(body.shapes.size() == 2);
  CHECK(body.shapes[0].luminance == doctest::Approx(0.85));
  CHECK(body.shapes[1].luminance == doctest::Approx(0.6));
  // The lowest row belongs to the side.
  const float bottom = light_at(0, truth.size_px.height / 2 - 0.5);
  CHECK(bottom == doctest::Approx(0.6).epsilon(0.02));
}

TEST_CASE("A ring printed on the puck lies on its face only") {
  SimulationParams params = small_world();
  const auto light_of = [&] {
    SimulatedTable table(params);
    return std::pair(table.truth(), table.log_intensity());
  };
  const auto [truth, plain] = light_of();
  params.scene.puck_print_luminance = 0.5;
  const auto [same_truth, printed] = light_of();
  CHECK(same_truth.position_px == truth.position_px);
  CHECK(same_truth.size_px.width == truth.size_px.width);

  int changed = 0;
  float brightest = 0;
  for (int y = 0; y < printed.height(); ++y) {
    for (int x = 0; x < printed.width(); ++x) {
      if (printed(x, y) == plain(x, y)) continue;
      ++changed;
      brightest = std::max(brightest, std::exp(printed(x, y)));
      // The ring ends at 0.72 of the radius; its edges are blurred.
      CHECK(std::abs(x - truth.position_px.x) < 0.36 * truth.size_px.width + 2);
      CHECK(std::abs(y - truth.position_px.y) < 0.36 * truth.size_px.height + 3);
    }
  }
  CHECK(changed > 20);
  CHECK(brightest > 0.3f);
  CHECK(brightest <= 0.501f);
  // The face is visible in its middle.
  const auto x = static_cast<int>(std::lround(truth.position_px.x));
  const auto y = static_cast<int>(std::lround(truth.position_px.y)) - 1;
  CHECK(printed(x, y) < std::log(0.35f));
}

TEST_CASE("A printed ring too large for the puck's face is refused") {
  SimulationParams params = small_world();
  params.scene.puck_print_radius_m = params.table.puck_radius_m;
  CHECK_NOTHROW(check(params));
  params.scene.puck_print_luminance = 0.5;
  CHECK_THROWS_WITH_AS(check(params), doctest::Contains("less than table.puck_radius_m"),
                       std::invalid_argument);
  params.scene.puck_print_radius_m = 0.002;
  CHECK_THROWS_WITH_AS(check(params), doctest::Contains("twice scene.puck_print_radius_m"),
                       std::invalid_argument);
}

TEST_CASE("Logos stand on the plain table, away from the markings") {
  SimulationParams params;
  params.scene.logo_count = SceneParams::kMostLogos;
  params.scene.logo_luminance = 0.123;
  SimulationParams plain = params;
  plain.scene.logo_count = 0;
  double area_m2 = 0;
  constexpr double kStep_m = 0.0025;
  for (double x_m = 0; x_m < params.table.length_m; x_m += kStep_m) {
    for (double y_m = -0.61; y_m < 0.61; y_m += kStep_m) {
      if (luminance_at(params, x_m, y_m) != 0.123) continue;
      area_m2 += kStep_m * kStep_m;
      // Nothing is printed within 2 cm.
      for (int i = 0; i < 8; ++i) {
        const double angle = std::numbers::pi / 4 * i;
        CHECK(luminance_at(plain, x_m + 0.02 * std::cos(angle), y_m + 0.02 * std::sin(angle)) ==
              plain.scene.table_luminance);
      }
    }
  }
  const double logo_m2 = std::numbers::pi * 0.0325 * 0.0325;
  CHECK(area_m2 == doctest::Approx(8 * logo_m2).epsilon(0.01));
}

TEST_CASE("A 15 m/s shot's events do not depend on the computation's slice length") {
  // 25 µs a slice: nothing moves more than 0.2 px between two drawings.
  const auto events_by_ms = [](std::int64_t slice_us) {
    SimulationParams params = quiet_world();
    params.seed = 2;
    params.slice_us = slice_us;
    params.sensor.jitter_us = 0;
    params.game.shot_speed_min_m_s = params.game.shot_speed_max_m_s = 15;
    params.game.wait_min_s = params.game.wait_max_s = 0;
    SimulatedTable table(params);
    std::vector<int> counts(600);
    while (table.now().us < 600'000) {
      EventPacket packet;
      table.advance(packet);
      for (const Event& event : packet.events) {
        ++counts[static_cast<std::size_t>(packet.time_of(event).us / 1000)];
      }
    }
    return counts;
  };
  const std::vector<int> fine = events_by_ms(25);
  const std::vector<int> usual = events_by_ms(500);
  double all = 0;
  double different = 0;
  for (std::size_t ms = 0; ms < fine.size(); ++ms) {
    all += fine[ms];
    different += std::abs(fine[ms] - usual[ms]);
  }
  CHECK(all > 20'000);
  CHECK(different < 0.01 * all);
}

TEST_CASE("A puck that leaves the image at the near side is not visible, and returns") {
  SimulationParams params = quiet_world();
  params.camera.pitch_deg = 18;
  params.moving_camera = true;
  TableGame game(params);
  const WorldView world(params.table, params.scene, params.sensor_size);
  const CameraView home(params.camera, params.sensor_size);
  const HeadMotion motion(params.head_motion, Random(params.seed, 20));
  int unseen_ms = 0;
  int exits = 0;
  bool was_inside = true;
  for (int ms = 0; ms < 20'000; ++ms) {
    for (std::int64_t i = 0; i < kStepsPerSecond / 1000; ++i) game.step();
    if (!game.puck()) continue;
    const CameraView view = home.turned(motion.pose_at(1e-3 * ms));
    const PixelBox box = world.puck_box(game.puck()->position, view);
    const bool inside = box.centre.y < params.sensor_size.height;
    exits += was_inside && !inside;
    was_inside = inside;
    if (box.centre.y < params.sensor_size.height + box.size.height / 2) continue;
    ++unseen_ms;
    CHECK(world.visible_share(game, view) < 0.01);
  }
  CHECK(exits >= 4);
  CHECK(unseen_ms > 200);
  CHECK(was_inside);
}

TEST_CASE("Dim light makes the same edge's events later") {
  const auto events_of = [](double lux) {
    SimulationParams params = quiet_world();
    params.light.illuminance_lux = lux;
    SimulatedTable table(params);
    EventPacket packet;
    while (table.now().us < 700'000) table.advance(packet);
    return packet.events.size();
  };
  // A third of the cutoff: changes shorter than its time constant are lost.
  CHECK(events_of(30) < events_of(300));
}

TEST_CASE("With all difficulties at once the same seed gives the same events") {
  SimulationParams params = small_world(6);
  params.moving_camera = true;
  params.scene.puck_luminance = 0.75;
  params.scene.puck_side_luminance = 0.6;
  params.scene.logo_count = 5;
  params.light = {100, 0.1, 100};
  params.sensor.readout_mev_s = 0.5;
  params.sensor.hot_pixel_fraction = 0.001;
  params.game.second_puck_speed_m_s = 2;
  params.game.rest_probability = 0.5;
  params.game.reach_probability = 0.5;
  SimulatedTable one(params);
  SimulatedTable other(params);
  Timestamp before;
  bool same = true;
  bool ordered = true;
  while (one.now().us < 400'000) {
    EventPacket events;
    EventPacket others;
    one.advance(events);
    other.advance(others);
    same &= events.events == others.events;
    for (const Event& event : events.events) {
      ordered &= events.time_of(event) >= before && events.time_of(event) < one.now();
      before = events.time_of(event);
    }
  }
  CHECK(same);
  CHECK(ordered);
  // Events beyond the readout's limit.
  CHECK(one.events_lost() > 0);
}

}  // namespace puck
