#include "common/simulation/scene_renderer.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "common/simulation/head_motion.h"
#include "common/simulation/static_scene.h"
#include "common/simulation/table_game.h"
#include "common/simulation/world_view.h"
#include "tests/simulation/test_worlds.h"

namespace puck {
namespace {

constexpr std::int64_t kSlice_us = 500;
constexpr int kGameStepsPerSlice = 20;

/// A renderer with its sensor.
struct Picture {
  Picture(const SimulationParams& params, const CameraView& home)
      : renderer(StaticScene(params.table, params.scene), home, params.sensor_size, {60, 60}),
        sensor(params.sensor, renderer.background(), params.seed) {}

  void draw(const TableGame& game, const WorldView& world, const CameraView& view, bool turn,
            Timestamp from, Timestamp to) {
    constexpr int kReach_px = 4;
    if (turn) renderer.turn_camera(view, kReach_px, from, to, sensor);
    std::vector<SceneBody> bodies;
    for (int i = 0; i < WorldView::kBodyCount; ++i) {
      bodies.push_back(world.body(static_cast<WorldView::Body>(i), game, view));
    }
    renderer.draw_bodies(bodies, WorldView::nearest_first(game),
                         std::vector<bool>(bodies.size(), true), from, to, sensor);
    EventPacket events;
    sensor.finish_slice(to, events);
  }

  SceneRenderer renderer;
  EventSensor sensor;
};

int count_of_wrong_pixels(bool moving) {
  SimulationParams params = small_world(2);
  params.game.shot_speed_max_m_s = 12;
  const CameraView home(params.camera, params.sensor_size);
  const WorldView world(params.table, params.scene, params.sensor_size);
  const HeadMotion motion(params.head_motion, Random(params.seed, 0));
  TableGame game(params);
  Picture kept(params, home);

  int wrong = 0;
  for (int slice = 1; slice <= 2400; ++slice) {
    const Timestamp from{kSlice_us * (slice - 1)}, to{kSlice_us * slice};
    for (int i = 0; i < kGameStepsPerSlice; ++i) game.step();
    const CameraView view =
        moving ? home.turned(motion.pose_at(static_cast<double>(to.us) * 1e-6)) : home;
    kept.draw(game, world, view, moving, from, to);
    if (slice % 800 != 0) continue;
    Picture fresh(params, home);
    fresh.draw(game, world, view, moving, {0}, {kSlice_us});
    for (int y = 0; y < params.sensor_size.height; ++y) {
      for (int x = 0; x < params.sensor_size.width; ++x) {
        const float difference = kept.sensor.log_intensity(x, y) - fresh.sensor.log_intensity(x, y);
        wrong += std::abs(difference) > 0.001f;
      }
    }
  }
  return wrong;
}

}  // namespace

TEST_CASE("An incremental picture equals a full one: still camera") {
  CHECK(count_of_wrong_pixels(false) == 0);
}

TEST_CASE("An incremental picture equals a full one: moving camera") {
  CHECK(count_of_wrong_pixels(true) == 0);
}

}  // namespace puck
