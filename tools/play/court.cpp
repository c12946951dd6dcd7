#include "tools/play/court.h"

#include "common/simulation/camera_view.h"
#include "common/simulation/simulated_table.h"
#include "common/simulation/table_game.h"
#include "common/vision/surface_tracker.h"

namespace puck {
namespace {

// Of an undrawn world: the period of the highest rate of estimates.
constexpr std::int64_t kStepUs = 200;
static_assert(kStepUs % PuckPhysics::kStep_us == 0);

SimulationParams seeded(SimulationParams world, std::int64_t seed) {
  world.seed = seed;
  world.autonomous_robot = false;
  return world;
}

class TruthCourt final : public Court {
 public:
  TruthCourt(const PlaySetup& setup, std::int64_t seed)
      : game_(seeded(setup.world, seed)),
        table_from_image_(exact_table_from_image(setup.world)),
        errors_(setup.errors, setup.world.sensor_size, seed) {
    look();
  }

  void advance() override {
    for (std::int64_t us = 0; us < kStepUs; us += PuckPhysics::kStep_us) game_.step();
    truth_.time = truth_.time + kStepUs;
    look();
  }
  const SimulatedTruth& truth() const override { return truth_; }
  void set_robot_mallet(double y_m) override { game_.set_robot_mallet(y_m); }
  PuckEstimate estimate() override { return errors_.estimate(); }

 private:
  void look() {
    const auto& puck = game_.puck();
    truth_.in_play = puck.has_value();
    if (puck) {
      truth_.position = puck->position;
      truth_.velocity = puck->velocity;
      if (const auto seen = table_from_image_.to_image(puck->position)) truth_.position_px = *seen;
    }
    truth_.robot_mallet = game_.robot_mallet().position;
    truth_.opponent_mallet = game_.opponent_mallet().position;
    truth_.counts = game_.counts();
    errors_.watch(truth_);
  }

  TableGame game_;
  Homography table_from_image_;
  EstimateErrors errors_;
  SimulatedTruth truth_;
};

class EventCourt final : public Court {
 public:
  EventCourt(const PlaySetup& setup, std::int64_t seed)
      : table_(seeded(setup.world, seed)),
        tracker_(setup.world.sensor_size, setup.tracker, setup.size_model),
        truth_(table_.truth()) {}

  void advance() override {
    packet_.events.clear();
    table_.advance(packet_);
    if (!packet_.empty()) tracker_.update(packet_);
    truth_ = table_.truth();
  }
  const SimulatedTruth& truth() const override { return truth_; }
  void set_robot_mallet(double y_m) override { table_.set_robot_mallet(y_m); }
  PuckEstimate estimate() override { return tracker_.estimate(); }

 private:
  SimulatedTable table_;
  SurfaceTracker tracker_;
  SimulatedTruth truth_;
  EventPacket packet_;
};

}  // namespace

std::unique_ptr<Court> make_court(const PlaySetup& setup, std::int64_t seed) {
  check(setup.world);
  if (setup.source == EstimateSource::kEvents) return std::make_unique<EventCourt>(setup, seed);
  return std::make_unique<TruthCourt>(setup, seed);
}

Homography exact_table_from_image(const SimulationParams& world) {
  return CameraView(world.camera, world.sensor_size)
      .table_from_image(world.scene.puck_height_m / 2);
}

}  // namespace puck
