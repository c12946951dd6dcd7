#include "common/messaging/conversions.h"

#include <algorithm>
#include <iterator>

namespace puck {
namespace {

template <typename Enum>
constexpr bool is(Enum value, int number) {
  return static_cast<int>(value) == number;
}

static_assert(is(TrackState::kSearching, puck_estimate_t::STATE_SEARCHING));
static_assert(is(TrackState::kTracking, puck_estimate_t::STATE_TRACKING));
static_assert(is(TrackState::kLost, puck_estimate_t::STATE_LOST));
static_assert(is(CommandMode::kFollow, arm_command_t::MODE_FOLLOW));
static_assert(is(CommandMode::kHold, arm_command_t::MODE_HOLD));
static_assert(is(CommandMode::kStop, arm_command_t::MODE_STOP));
static_assert(is(CommandMode::kReset, arm_command_t::MODE_RESET));
static_assert(is(CameraControlMode::kPause, camera_control_t::MODE_PAUSE));
static_assert(is(CameraControlMode::kResume, camera_control_t::MODE_RESUME));
static_assert(is(CameraControlMode::kStep, camera_control_t::MODE_STEP));
static_assert(is(CameraControlMode::kSeek, camera_control_t::MODE_SEEK));
static_assert(is(CameraControlMode::kSpeed, camera_control_t::MODE_SPEED));
static_assert(is(ArmActivity::kIdle, arm_state_t::STATE_IDLE));
static_assert(is(ArmActivity::kMoving, arm_state_t::STATE_MOVING));
static_assert(is(ArmActivity::kHolding, arm_state_t::STATE_HOLDING));
static_assert(is(ArmActivity::kStopped, arm_state_t::STATE_STOPPED));
static_assert(is(ArmActivity::kFault, arm_state_t::STATE_FAULT));
static_assert(is(GamePhase::kWaiting, game_state_t::PHASE_WAITING));
static_assert(is(GamePhase::kRally, game_state_t::PHASE_RALLY));
static_assert(is(GamePhase::kShotAtRobot, game_state_t::PHASE_SHOT_AT_ROBOT));
static_assert(is(GamePhase::kGoal, game_state_t::PHASE_GOAL));
static_assert(is(GamePhase::kPuckStuck, game_state_t::PHASE_PUCK_STUCK));
static_assert(is(GamePhase::kPuckOutOfView, game_state_t::PHASE_PUCK_OUT_OF_VIEW));

// Sensor time of HEAD when it is not known.
constexpr std::int64_t kTimeUnknown = -1;

bool has(const puck_estimate_t& message, std::int32_t flag) { return (message.flags & flag) != 0; }

template <typename Message>
Message with_header(const MessageHeader& header) {
  Message message{};
  message.utime = header.utime;
  message.session = header.session;
  message.seq = header.seq;
  return message;
}

template <typename Message>
MessageHeader header_of(const Message& message) {
  return {message.utime, message.session, message.seq};
}

}  // namespace

puck_estimate_t to_message(const PublishedEstimate& estimate) {
  auto message = with_header<puck_estimate_t>(estimate);
  message.events_session = estimate.events_session;
  message.sensor_us = estimate.newest_event.us;
  message.events_applied = estimate.events_applied;
  message.event_utime = estimate.event_utime.value_or(0);
  message.packet_received_utime = estimate.packet_received_utime;
  message.tracking_started_utime = estimate.tracking_started_utime;
  message.backlog_us = estimate.backlog_us;
  message.backlog_events = estimate.backlog_events;
  message.state = static_cast<std::int8_t>(estimate.state);
  if (estimate.resting) message.flags |= puck_estimate_t::FLAG_RESTING;
  if (estimate.coasting) message.flags |= puck_estimate_t::FLAG_COASTING;
  if (estimate.is_live) message.flags |= puck_estimate_t::FLAG_LIVE;
  if (estimate.left_image) {
    message.flags |= puck_estimate_t::FLAG_LEFT_IMAGE;
    message.left_x_px = estimate.left_image->x;
    message.left_y_px = estimate.left_image->y;
  }
  if (estimate.position) {
    message.flags |= puck_estimate_t::FLAG_POSITION;
    message.x_px = estimate.position->x;
    message.y_px = estimate.position->y;
    message.vx_px_s = estimate.velocity.x;
    message.vy_px_s = estimate.velocity.y;
    message.width_px = estimate.size.width;
    message.height_px = estimate.size.height;
    std::copy(estimate.covariance.begin(), estimate.covariance.end(), message.covariance);
  }
  message.score = estimate.score;
  message.region_x = estimate.region.x;
  message.region_y = estimate.region.y;
  message.region_width = std::max(estimate.region.width, 0);
  message.region_height = std::max(estimate.region.height, 0);
  message.image_width = estimate.sensor.width;
  message.image_height = estimate.sensor.height;
  message.packets_received = estimate.packets.received;
  message.packets_lost = estimate.packets.lost;
  message.packets_late = estimate.packets.late;
  message.packets_rejected = estimate.packets.rejected;
  message.events_lost = estimate.packets.events_lost;
  message.events_skipped = estimate.packets.events_skipped;
  message.events_dropped = estimate.packets.events_dropped;
  return message;
}

PublishedEstimate from_message(const puck_estimate_t& message) {
  PublishedEstimate estimate{header_of(message)};
  estimate.events_session = message.events_session;
  estimate.newest_event = Timestamp{message.sensor_us};
  estimate.events_applied = message.events_applied;
  if (message.event_utime != 0) estimate.event_utime = message.event_utime;
  estimate.packet_received_utime = message.packet_received_utime;
  estimate.tracking_started_utime = message.tracking_started_utime;
  estimate.backlog_us = message.backlog_us;
  estimate.backlog_events = message.backlog_events;
  estimate.state = static_cast<TrackState>(message.state);
  estimate.resting = has(message, puck_estimate_t::FLAG_RESTING);
  estimate.coasting = has(message, puck_estimate_t::FLAG_COASTING);
  estimate.is_live = has(message, puck_estimate_t::FLAG_LIVE);
  if (has(message, puck_estimate_t::FLAG_LEFT_IMAGE)) {
    estimate.left_image = Pixel{message.left_x_px, message.left_y_px};
  }
  if (has(message, puck_estimate_t::FLAG_POSITION)) {
    estimate.position = Pixel{message.x_px, message.y_px};
    estimate.velocity = {message.vx_px_s, message.vy_px_s};
    estimate.size = {message.width_px, message.height_px};
    std::copy(std::begin(message.covariance), std::end(message.covariance),
              estimate.covariance.begin());
  }
  estimate.score = message.score;
  estimate.region = {message.region_x, message.region_y, message.region_width,
                     message.region_height};
  estimate.sensor = {message.image_width, message.image_height};
  estimate.packets = {message.packets_received, message.packets_lost, message.packets_late,
                      message.packets_rejected, message.events_lost,  message.events_skipped,
                      message.events_dropped};
  return estimate;
}

puck_trajectory_t to_message(const TableTrajectory& trajectory) {
  auto message = with_header<puck_trajectory_t>(trajectory);
  message.estimate_session = trajectory.estimate.session;
  message.estimate_seq = trajectory.estimate.seq;
  message.sensor_us = trajectory.at.us;
  message.head_known = trajectory.head_known;
  message.line_x_m = trajectory.line_x_m;
  if (trajectory.track) {
    const auto& [position, velocity] = trajectory.track->state;
    message.validity = trajectory.is_coasting ? puck_trajectory_t::VALIDITY_COASTING
                                              : puck_trajectory_t::VALIDITY_TRACKED;
    message.x_m = position.x_m;
    message.y_m = position.y_m;
    message.vx_m_s = velocity.x_m_s;
    message.vy_m_s = velocity.y_m_s;
    Eigen::Map<Matrix4>{message.covariance} = trajectory.track->covariance;
  }
  message.path_length = static_cast<std::int32_t>(trajectory.path.size());
  for (auto* const values : {&message.path_t_s, &message.path_x_m, &message.path_y_m}) {
    values->reserve(trajectory.path.size());
  }
  for (const PathPoint& point : trajectory.path) {
    message.path_t_s.push_back(point.t_s);
    message.path_x_m.push_back(point.position.x_m);
    message.path_y_m.push_back(point.position.y_m);
  }
  if (const std::optional<Intercept>& crossing = trajectory.crossing) {
    message.crosses = 1;
    message.crossing_y_m = crossing->y_m;
    message.crossing_in_s = crossing->in_s;
    message.crossing_sigma_y_m = crossing->sigma_y_m;
    message.crossing_sigma_t_s = crossing->sigma_t_s;
    message.crossing_speed_m_s = crossing->speed_m_s;
    message.crossing_bounces = crossing->bounces;
  }
  return message;
}

arm_command_t to_message(const ArmCommand& command) {
  auto message = with_header<arm_command_t>(command);
  message.mode = static_cast<std::int8_t>(command.mode);
  message.from_operator = command.from_operator;
  message.target_m = command.target_m;
  message.target_normalised = command.target_normalised;
  message.arrive_in_us = command.arrive_in_us;
  message.valid_for_us = command.valid_for_us;
  message.estimate_session = command.estimate.session;
  message.estimate_seq = command.estimate.seq;
  message.arm_session = command.arm_session;
  return message;
}

ArmCommand from_message(const arm_command_t& message) {
  return {header_of(message),         static_cast<CommandMode>(message.mode),
          message.from_operator != 0, message.target_m,
          message.target_normalised,  message.arrive_in_us,
          message.valid_for_us,       {message.estimate_session, message.estimate_seq},
          message.arm_session};
}

camera_control_t to_message(const CameraControl& control) {
  auto message = with_header<camera_control_t>(control);
  message.mode = static_cast<std::int8_t>(control.mode);
  message.camera_session = control.camera_session;
  message.request = control.request;
  message.position_us = control.position_us;
  message.step_us = control.step_us;
  message.speed = control.speed;
  return message;
}

CameraControl from_message(const camera_control_t& message) {
  return {header_of(message),     static_cast<CameraControlMode>(message.mode),
          message.camera_session, message.request,
          message.position_us,    message.step_us,
          message.speed};
}

arm_state_t to_message(const ArmState& state) {
  auto message = with_header<arm_state_t>(state);
  message.state = static_cast<std::int8_t>(state.activity);
  message.reason = state.reason;
  message.faults = state.faults;
  message.back_end = state.back_end;
  message.line_x_m = state.line_x_m;
  message.line_min_m = state.line_min_m;
  message.line_max_m = state.line_max_m;
  message.position_m = state.position_m;
  message.position_normalised = state.position_normalised;
  message.velocity_m_s = state.velocity_m_s;
  message.target_m = state.target_m;
  message.joint_deg = state.joint_deg;
  message.joint_velocity_deg_s = state.joint_velocity_deg_s;
  message.command_session = state.command.session;
  message.command_seq = state.command.seq;
  message.estimate_session = state.estimate.session;
  message.estimate_seq = state.estimate.seq;
  message.commands_refused = state.commands_refused;
  message.estimate_to_motion_us = state.estimate_to_motion_us;
  return message;
}

ArmState from_message(const arm_state_t& message) {
  ArmState state{header_of(message)};
  state.activity = static_cast<ArmActivity>(message.state);
  state.reason = message.reason;
  state.faults = message.faults;
  state.back_end = message.back_end;
  state.line_x_m = message.line_x_m;
  state.line_min_m = message.line_min_m;
  state.line_max_m = message.line_max_m;
  state.position_m = message.position_m;
  state.position_normalised = message.position_normalised;
  state.velocity_m_s = message.velocity_m_s;
  state.target_m = message.target_m;
  state.joint_deg = message.joint_deg;
  state.joint_velocity_deg_s = message.joint_velocity_deg_s;
  state.command = {message.command_session, message.command_seq};
  state.estimate = {message.estimate_session, message.estimate_seq};
  state.commands_refused = message.commands_refused;
  state.estimate_to_motion_us = message.estimate_to_motion_us;
  return state;
}

game_state_t to_message(const GameState& game) {
  auto message = with_header<game_state_t>(game);
  message.sensor_us = game.at.us;
  message.phase = static_cast<std::int8_t>(game.phase);
  message.phase_since_us = game.phase_since.us;
  message.goals_for = game.goals_for;
  message.goals_against = game.goals_against;
  message.rally_hits = game.rally_hits;
  message.longest_rally = game.longest_rally;
  message.shots = game.shots;
  message.saves = game.saves;
  return message;
}

GameState from_message(const game_state_t& message) {
  return {header_of(message),
          {static_cast<GamePhase>(message.phase),
           {message.phase_since_us},
           message.goals_for,
           message.goals_against,
           message.rally_hits,
           message.longest_rally,
           message.shots,
           message.saves},
          {message.sensor_us}};
}

head_state_t to_message(const HeadState& head) {
  auto message = with_header<head_state_t>(head);
  message.sensor_us = head.at ? head.at->us : kTimeUnknown;
  message.yaw_deg = head.yaw_deg;
  message.pitch_deg = head.pitch_deg;
  message.roll_deg = head.roll_deg;
  message.yaw_deg_s = head.yaw_deg_s;
  message.pitch_deg_s = head.pitch_deg_s;
  message.roll_deg_s = head.roll_deg_s;
  return message;
}

HeadState from_message(const head_state_t& message) {
  HeadState head{header_of(message),
                 {message.yaw_deg, message.pitch_deg, message.roll_deg, message.yaw_deg_s,
                  message.pitch_deg_s, message.roll_deg_s}};
  if (message.sensor_us != kTimeUnknown) head.at = Timestamp{message.sensor_us};
  return head;
}

ground_truth_t to_message(const GroundTruth& truth) {
  auto message = with_header<ground_truth_t>(truth);
  message.sensor_us = truth.time.us;
  message.x_px = truth.centre.x;
  message.y_px = truth.centre.y;
  message.width_px = truth.size.width;
  message.height_px = truth.size.height;
  message.visible = truth.visible;
  message.in_play = truth.in_play;
  message.x_m = truth.on_table.position.x_m;
  message.y_m = truth.on_table.position.y_m;
  message.vx_m_s = truth.on_table.velocity.x_m_s;
  message.vy_m_s = truth.on_table.velocity.y_m_s;
  message.shots = truth.shots;
  message.saves = truth.saves;
  message.goals_against = truth.goals_against;
  message.goals_for = truth.goals_for;
  return message;
}

GroundTruth from_message(const ground_truth_t& message) {
  return {header_of(message),
          {{message.sensor_us},
           {message.x_px, message.y_px},
           {message.width_px, message.height_px},
           message.visible},
          message.in_play != 0,
          {{message.x_m, message.y_m}, {message.vx_m_s, message.vy_m_s}},
          message.shots,
          message.saves,
          message.goals_against,
          message.goals_for};
}

}  // namespace puck
