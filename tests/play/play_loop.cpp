#include "tests/play/play_loop.h"

#include <cmath>

namespace puck {
namespace {

constexpr std::uint64_t kErrorStream = 77;
constexpr double kErrorMemory_us = 2'000;
constexpr double kSuddenM_s = 0.3;
constexpr std::int64_t kArmPeriod_us = 1'000;

}  // namespace

PlayLoop::PlayLoop(const SimulationParams& world, const TrackerErrors& errors,
                   const PlayBridgeParams& bridge)
    : errors_(errors),
      game_(world),
      bridge_(bridge, camera_, world.table),
      arm_(world.arm, world.table.robot_line_half_m),
      random_(world.seed, kErrorStream) {}

void PlayLoop::run(double seconds) {
  const std::int64_t end_us = t_us_ + std::llround(seconds * 1e6);
  while (t_us_ < end_us) {
    game_.step();
    t_us_ += PuckPhysics::kStep_us;
    if (t_us_ % errors_.period_us == 0) see(game_.puck());
    if (t_us_ % kArmPeriod_us == 0) hear();
  }
}

void PlayLoop::see(const std::optional<DiscState>& puck) {
  puck_estimate_t message{};
  message.session = 3001;
  message.seq = seq_++;
  message.events_session = 1;
  message.sensor_us = t_us_;
  message.events_applied = t_us_;
  message.event_utime = kStartUtime + t_us_;
  message.utime = kStartUtime + t_us_ + errors_.delay_us;
  message.image_width = 640;
  message.image_height = 480;
  message.state = puck_estimate_t::STATE_LOST;
  const double period_s = static_cast<double>(errors_.period_us) * 1e-6;
  if (random_.uniform() < errors_.losses_per_s * period_s) {
    lost_until_us_ = t_us_ + std::llround(random_.uniform(5'000, 80'000));
  }
  if (puck) {
    const TableVelocity& v = puck->velocity;
    const bool sudden =
        std::hypot(v.x_m_s - last_velocity_.x_m_s, v.y_m_s - last_velocity_.y_m_s) > kSuddenM_s;
    last_velocity_ = v;
    if (sudden && random_.uniform() < errors_.lost_at_hit) {
      lost_until_us_ = t_us_ + std::llround(random_.uniform(5'000, 40'000));
    }
    const auto pixel = camera_.to_image(puck->position);
    constexpr double kAhead_s = 1e-5;
    const auto next = camera_.to_image(
        {puck->position.x_m + kAhead_s * v.x_m_s, puck->position.y_m + kAhead_s * v.y_m_s});
    const bool visible = pixel && next && pixel->x >= 0 && pixel->x < 640 && pixel->y >= 0 &&
                         pixel->y < 480 && t_us_ >= lost_until_us_;
    if (visible) {
      const double keep = std::exp(-static_cast<double>(errors_.period_us) / kErrorMemory_us);
      const double fresh = errors_.sigma_px * std::sqrt(1 - keep * keep);
      error_px_ = {keep * error_px_.x + fresh * random_.normal(),
                   keep * error_px_.y + fresh * random_.normal()};
      message.state = puck_estimate_t::STATE_TRACKING;
      message.flags = std::int32_t{puck_estimate_t::FLAG_POSITION} | puck_estimate_t::FLAG_LIVE;
      message.x_px = pixel->x + error_px_.x;
      message.y_px = pixel->y + error_px_.y;
      message.vx_px_s = (next->x - pixel->x) / kAhead_s + errors_.sigma_px_s * random_.normal();
      message.vy_px_s = (next->y - pixel->y) / kAhead_s + errors_.sigma_px_s * random_.normal();
      message.covariance[0] = message.covariance[5] = 0.01 + errors_.sigma_px * errors_.sigma_px;
      if (random_.uniform() < errors_.strays_per_s * period_s) {
        message.x_px = random_.uniform(0, 640);
        message.y_px = random_.uniform(100, 480);
      }
    }
  }
  on_the_way_.push_back(message);
}

void PlayLoop::hear() {
  const HostNow at = now();
  const SenderClock clock = ClockOffset{};
  arm_state_t arm{};
  arm.utime = at.utime;
  arm.session = 1001;
  arm.seq = t_us_ / kArmPeriod_us;
  arm.line_min_m = -0.3;
  arm.line_max_m = 0.3;
  arm.position_m = arm_.position_m();
  arm.velocity_m_s = arm_.velocity_m_s();
  bridge_.hear(arm, at, clock);
  while (!on_the_way_.empty() && on_the_way_.front().utime <= at.utime) {
    bridge_.hear(on_the_way_.front(), at, clock);
    on_the_way_.pop_front();
  }
  if (const auto command = bridge_.next_command(at)) {
    arm_.set_target(command->target_m);
    command_until_us_ = t_us_ + command->valid_for_us;
  } else if (t_us_ > command_until_us_) {
    arm_.hold();
  }
  arm_.step(static_cast<double>(kArmPeriod_us) * 1e-6);
  game_.set_robot_mallet(arm_.position_m());
}

}  // namespace puck
