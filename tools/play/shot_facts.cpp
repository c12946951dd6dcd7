#include "tools/play/shot_facts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/simulation/table_game.h"
#include "tools/play/stepped_arm.h"

namespace puck {
namespace {

constexpr std::int64_t kThinkUs = 1000;
constexpr int kStepsPerThought = static_cast<int>(kThinkUs / PuckPhysics::kStep_us);
// Before the hit, a puck changes its velocity by less than this in a millisecond.
constexpr double kHit_m_s = 0.1;
// A slower puck no longer approaches the robot.
constexpr double kSlowest_m_s = 0.1;
// The Referee judges a hit 10 ms after its end.
constexpr std::int64_t kJudgedUs = 25'000;
constexpr std::int64_t kLongestWaitUs = 10'000'000;

// A bridge with access to the truth.
class Oracle {
 public:
  explicit Oracle(const PlaySetup& setup)
      : physics_(setup.world.table, setup.world.physics),
        line_x_m_(setup.world.table.contact_line_x_m()),
        arm_(setup.arm) {}

  /// Place and time at which a free puck crosses the line; false if it turns back before.
  bool cross(DiscState puck, Timestamp now, ShotFacts& facts) const {
    while (puck.position.x_m > line_x_m_) {
      if (puck.velocity.x_m_s > -kSlowest_m_s) return false;
      physics_.glide(puck, PuckPhysics::kStep_s);
      now = now + PuckPhysics::kStep_us;
    }
    facts.crossing = now;
    facts.crossing_y_m = puck.position.y_m;
    return true;
  }

  /// Moves the arm towards the target and returns its position.
  double move(Timestamp now, double target_m) {
    const HostNow host = host_time_of(now);
    PublishedEstimate estimate{{host.utime, kTrackerSession, seq_}};
    estimate.events_session = kCameraSession;
    estimate.newest_event = now;
    estimate.state = TrackState::kTracking;
    estimate.position = Pixel{};
    estimate.is_live = true;
    arm_.controller().hear(estimate, host, kSameClock);

    const ArmState state = arm_.controller().state();
    ArmCommand command{{host.utime, kBridgeSession, seq_++}};
    command.target_m = std::clamp(target_m, state.line_min_m, state.line_max_m);
    command.valid_for_us = 100'000;
    command.estimate = estimate.id();
    command.arm_session = kArmSession;
    arm_.controller().hear(command, host, kSameClock);
    arm_.step_until(now);
    return arm_.controller().position_m();
  }

 private:
  PuckPhysics physics_;
  double line_x_m_;
  SteppedArm arm_;
  std::int64_t seq_ = 0;
};

// The puck after its first hit; empty before.
class FirstHit {
 public:
  bool has_happened(const std::optional<DiscState>& puck) {
    if (puck && before_ && !happened_) {
      const double change_m_s = std::hypot(puck->velocity.x_m_s - before_->velocity.x_m_s,
                                           puck->velocity.y_m_s - before_->velocity.y_m_s);
      happened_ = change_m_s > kHit_m_s;
    }
    before_ = puck;
    return happened_;
  }

 private:
  std::optional<DiscState> before_;
  bool happened_ = false;
};

// Whether a mallet at rest in the middle saves the first shot.
bool saves_by_waiting(const SimulationParams& world) {
  TableGame game(world);
  for (std::int64_t us = 0; us < kLongestWaitUs; us += PuckPhysics::kStep_us) {
    game.step();
    const GameCounts& counts = game.counts();
    if (counts.saves + counts.goals_against > 0) return counts.saves > 0;
  }
  return false;
}

}  // namespace

ShotFacts find_shot(const PlaySetup& setup, std::int64_t seed) {
  SimulationParams world = setup.world;
  world.seed = seed;
  world.autonomous_robot = false;
  TableGame game(world);
  Oracle oracle(setup);
  FirstHit first_hit;
  ShotFacts facts;
  facts.seed = seed;
  double target_m = 0;
  for (Timestamp now{kThinkUs}; now.us < kLongestWaitUs; now = now + kThinkUs) {
    for (int step = 0; step < kStepsPerThought; ++step) game.step();
    const GameCounts& counts = game.counts();
    if (counts.saves + counts.goals_against > 0) {
      facts.is_reachable = counts.goals_against == 0;
      break;
    }
    const auto& puck = game.puck();
    if (first_hit.has_happened(puck) && !facts.is_shot) {
      if (facts.hit.us == 0) facts.hit = now;
      if (puck && oracle.cross(*puck, now, facts)) {
        target_m = facts.crossing_y_m;
        facts.speed_m_s = std::hypot(puck->velocity.x_m_s, puck->velocity.y_m_s);
      }
      facts.is_shot = counts.shots > 0;
      if (!facts.is_shot && now - facts.hit > kJudgedUs) break;
    }
    game.set_robot_mallet(oracle.move(now, target_m));
  }
  if (facts.is_shot) facts.hits_waiting_mallet = saves_by_waiting(world);
  return facts;
}

}  // namespace puck
