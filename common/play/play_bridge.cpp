#include "common/play/play_bridge.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

// Longest delay of estimates on the way: sensor time advances faster only while it is made up for.
constexpr std::int64_t kMaxHeldUpUs = 500'000;
constexpr std::int64_t kGamePeriodUs = 100'000;
// A track with a larger uncertainty of its velocity, 0.5 m/s, is not used for the game.
constexpr double kGameSpeedVariance = 0.25;
// A target that moved by more is sent at once.
constexpr double kNewTargetM = 0.005;
constexpr double kMostCommandsHz = 1000;
constexpr double kPathHorizonS = 0.5;
constexpr double kPathStepS = 0.02;

bool is_due(std::optional<std::int64_t> last_us, double hz, std::int64_t now_us) {
  return !last_us || static_cast<double>(now_us - *last_us) >= 1e6 / hz;
}

void check(const PlayBridgeParams& params) {
  const auto require = [](bool holds, const std::string& what, double got) {
    if (!holds) throw std::invalid_argument(what + ", got " + std::to_string(got));
  };
  require(params.max_trajectory_hz >= 1 && params.max_trajectory_hz <= 10'000,
          "bridge.max_trajectory_hz must be between 1 and 10000", params.max_trajectory_hz);
  require(params.command_hz >= 20 && params.command_hz <= 1000,
          "bridge.command_hz must be between 20 and 1000", params.command_hz);
  require(params.valid_for_us >= 1000 && params.valid_for_us <= 100'000,
          "bridge.valid_for_ms must be between 1 and 100",
          static_cast<double>(params.valid_for_us) / 1000);
  require(params.max_head_deg >= 0 && params.max_head_deg <= 180,
          "bridge.max_head_deg must be between 0 and 180", params.max_head_deg);
}

}  // namespace

PlayBridge::PlayBridge(const PlayBridgeParams& params, const Homography& table_from_image,
                       const TableGeometry& table, const std::optional<PinholeCamera>& camera)
    : params_(params),
      table_(table),
      gate_(params.gate, table),
      motion_(table, params.motion),
      filter_(motion_, params.filter),
      probation_({params.probation_us, params.gate.max_speed_m_s}),
      predictor_(motion_, params.intercept),
      strategy_(params.strategy, table),
      game_(motion_),
      arm_(params.gate.max_clock_error_us),
      home_(table_from_image),
      head_(params.head),
      is_blind_(params.needs_head) {
  check(params_);
  if (camera) camera_.emplace(table_from_image, *camera);
}

void PlayBridge::follow_session(const PublishedEstimate& estimate, const HostNow& now) {
  const Timestamp latest = newest_sensor_ + (now.monotonic_us - newest_heard_us_) + kMaxHeldUpUs;
  const bool goes_on = events_session_ == estimate.events_session &&
                       estimate.newest_event >= newest_sensor_ && estimate.newest_event <= latest;
  events_session_ = estimate.events_session;
  newest_heard_us_ = now.monotonic_us;
  if (goes_on) return;
  // Another camera, or a restarted clock.
  filter_.reset();
  probation_.forget();
  game_.forget_time();
  basis_.reset();
}

void PlayBridge::hear(const PublishedEstimate& estimate, const HostNow& now,
                      const SenderClock& sender) {
  TableMeasurement measurement;
  const std::optional<TableView> view = view_of(estimate.newest_event);
  const EstimateVerdict verdict =
      gate_.judge(estimate, now, sender, view ? &*view : nullptr, measurement);
  // A measurement of another camera or from the future would make all later ones late.
  const bool is_of_past =
      estimate.events_session == events_session_ && estimate.newest_event < newest_sensor_;
  if (verdict == EstimateVerdict::kBelated && is_of_past) filter_.update(measurement);
  if (!is_news(verdict)) return;
  is_blind_ = !view;
  tracked_ = verdict == EstimateVerdict::kGood;
  if (verdict == EstimateVerdict::kMalformed) return;
  follow_session(estimate, now);
  newest_ = estimate.id();
  newest_sensor_ = estimate.newest_event;
  trajectory_due_ = true;
  // `sender` has a value, since the gate accepted the estimate's age.
  const std::int64_t age_us =
      estimate.event_utime ? now.utime - sender->to_own(*estimate.event_utime) : -1;
  const bool age_is_known = age_us >= 0;
  if (age_is_known) sensor_ahead_us_ = newest_sensor_.us + age_us - now.monotonic_us;
  if (!tracked_) {
    // Without a puck there may be no events, and sensor time would not advance.
    game_.miss(newest_sensor_ + (age_is_known ? age_us : 0));
    return;
  }

  const MeasurementUse use = filter_.update(measurement);
  const std::optional<PuckTrack> track = filter_.at(newest_sensor_);
  probation_.take(measurement, use, track);
  if (use == MeasurementUse::kOutlier) ++outliers_;
  if (use == MeasurementUse::kLate) ++frozen_;
  if (!probation_.is_trusted()) ++untrusted_;
  if (!is_good(use)) return;
  basis_ =
      Basis{estimate.id(), newest_sensor_ + (age_is_known && !measurement.resting ? age_us : 0),
            now.monotonic_us};
  if (track && largest_speed_variance(*track) < kGameSpeedVariance) {
    game_.see(newest_sensor_, *track);
  }
}

void PlayBridge::hear(const HeadState& head, const HostNow& now) {
  // Late messages and those of another robot's head must not move this camera's pose.
  const auto verdict = head_publisher_.hear(head.session, head.seq, now.monotonic_us);
  if (verdict != SinglePublisher::Verdict::kNewPublisher &&
      verdict != SinglePublisher::Verdict::kAccepted) {
    return;
  }
  if (verdict == SinglePublisher::Verdict::kNewPublisher) head_.forget();
  hears_head_ = true;
  if (head.at) {
    if (is_sensor_time(*head.at)) head_.add(*head.at, head);
  } else if (sensor_ahead_us_) {
    // A robot's encoders have no sensor time: their pose is current.
    head_.add({now.monotonic_us + *sensor_ahead_us_}, head);
  }
  const double furthest_deg =
      std::max({std::abs(head.yaw_deg), std::abs(head.pitch_deg), std::abs(head.roll_deg)});
  head_is_home_ = furthest_deg <= params_.max_head_deg;
  if (!camera_) is_blind_ = !head_is_home_;
}

std::optional<TableView> PlayBridge::view_of(Timestamp t) const {
  if (!hears_head_) return params_.needs_head ? std::nullopt : std::optional(home_);
  if (!camera_) return head_is_home_ ? std::optional(home_) : std::nullopt;
  const std::optional<HeadPose> pose = head_.at(t);
  return pose ? camera_->view_at(*pose) : std::nullopt;
}

Timestamp PlayBridge::sensor_now(const HostNow& now) const {
  return basis_->sensor_at_receipt + (now.monotonic_us - basis_->received_us);
}

std::optional<PuckTrack> PlayBridge::live_track(const HostNow& now) const {
  if (!tracked_ || !basis_ || !probation_.is_trusted()) return std::nullopt;
  if (now.monotonic_us - basis_->received_us > params_.gate.max_age_us) return std::nullopt;
  return filter_.at(sensor_now(now));
}

std::optional<TableTrajectory> PlayBridge::next_trajectory(const HostNow& now) {
  if (!trajectory_due_ ||
      !is_due(last_trajectory_us_, params_.max_trajectory_hz, now.monotonic_us)) {
    return std::nullopt;
  }
  trajectory_due_ = false;
  last_trajectory_us_ = now.monotonic_us;

  TableTrajectory trajectory;
  trajectory.estimate = newest_;
  trajectory.at = newest_sensor_;
  trajectory.head_known = !is_blind_;
  trajectory.line_x_m = predictor_.line_x_m();
  trajectory.track = filter_.at(newest_sensor_);
  if (!trajectory.track) return trajectory;
  trajectory.is_coasting = !tracked_ || filter_.newest() != newest_sensor_;
  std::optional<TablePoint> mallet;
  if (const ArmState* arm = arm_.arm(now)) {
    mallet = TablePoint{table_.robot_line_x_m, arm->position_m};
  }
  trajectory.path.reserve(static_cast<std::size_t>(kPathHorizonS / kPathStepS) + 2);
  predictor_.predict_path(*trajectory.track, mallet, kPathHorizonS, kPathStepS, trajectory.path);
  trajectory.crossing = predictor_.predict(*trajectory.track);
  return trajectory;
}

std::optional<ArmCommand> PlayBridge::next_command(const HostNow& now) {
  const bool due = is_due(last_command_us_, params_.command_hz, now.monotonic_us);
  const bool may_be_early = basis_ && basis_->id.seq != last_basis_seq_ &&
                            is_due(last_command_us_, kMostCommandsHz, now.monotonic_us);
  if (!due && !may_be_early) return std::nullopt;
  const ArmState* arm = arm_.arm(now);
  if (arm == nullptr || is_blind_) return std::nullopt;
  const std::optional<PuckTrack> track = live_track(now);
  if (!track) return std::nullopt;

  // The part of the line that both the table's file and the arm allow.
  const double lowest_m = std::max(-table_.robot_line_half_m, arm->line_min_m);
  const double highest_m = std::min(table_.robot_line_half_m, arm->line_max_m);
  if (!(lowest_m <= highest_m)) return std::nullopt;
  const Wish wish = strategy_.decide(*track, predictor_.predict(*track));
  const double target_m = std::clamp(wish.y_m, lowest_m, highest_m);
  last_basis_seq_ = basis_->id.seq;
  if (!due && std::abs(target_m - last_target_m_) < kNewTargetM) return std::nullopt;
  last_target_m_ = target_m;

  ArmCommand command;
  command.target_m = target_m;
  const double middle_m = (arm->line_min_m + arm->line_max_m) / 2;
  const double half_m = (arm->line_max_m - arm->line_min_m) / 2;
  command.target_normalised =
      half_m > 0 ? std::clamp((command.target_m - middle_m) / half_m, -1.0, 1.0) : 0;
  command.arrive_in_us = static_cast<std::int64_t>(std::max(0.0, wish.arrive_in_s) * 1e6);
  command.valid_for_us = params_.valid_for_us;
  command.estimate = basis_->id;
  command.arm_session = arm->session;
  last_command_us_ = now.monotonic_us;
  ++commands_;
  return command;
}

std::optional<GameState> PlayBridge::next_game(const HostNow& now) {
  const GameBelief& belief = game_.belief();
  const bool waited = !last_game_us_ || now.monotonic_us - *last_game_us_ >= kGamePeriodUs;
  if (!waited && belief == published_game_) return std::nullopt;
  last_game_us_ = now.monotonic_us;
  published_game_ = belief;
  return GameState{{}, belief, newest_sensor_};
}

}  // namespace puck
