#include "common/messaging/wire_layout.h"

#include <algorithm>
#include <array>
#include <limits>

namespace puck {
namespace {

constexpr std::int64_t kMostInt32 = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t kMostInt64 = std::numeric_limits<std::int64_t>::max();

// Limits of lengths: far above what we send, far below what could do harm.
constexpr std::int64_t kMaxText = 255;
constexpr std::int64_t kMaxEventsInPacket = 16384;
constexpr std::int64_t kLongestPacket_us = 4095;
constexpr std::int64_t kMaxPath = 4096;
constexpr std::int64_t kMaxJoints = 64;
constexpr std::int64_t kMaxCounters = 256;
constexpr std::int64_t kMaxLatencies = 64;
constexpr std::int64_t kMaxPongs = 64;

/// Values count from 0.
constexpr WireField one_of(std::string_view name, std::span<const std::string_view> meanings) {
  const auto max = static_cast<std::int64_t>(meanings.size()) - 1;
  return {name, WireKind::kInt8, 0, max, {}, 1, meanings};
}
constexpr WireField whole32(std::string_view name, std::int64_t min, std::int64_t max) {
  return {name, WireKind::kInt32, min, max, {}, 1};
}
/// A count or a time; never negative.
constexpr WireField amount(std::string_view name) {
  return {name, WireKind::kInt64, 0, kMostOnWire, {}, 1};
}
/// A session; 0: none.
constexpr WireField reference(std::string_view name) {
  return {name, WireKind::kInt64, 0, kMostInt64, {}, 1};
}
constexpr WireField real(std::string_view name) { return {name, WireKind::kDouble, 0, 0, {}, 1}; }
constexpr WireField truth_value(std::string_view name) {
  return {name, WireKind::kBoolean, 0, 1, {}, 1};
}
constexpr WireField text(std::string_view name) {
  return {name, WireKind::kString, 0, kMaxText, {}, 1};
}
constexpr WireField array_of(WireField element, std::string_view count_field) {
  element.count_field = count_field;
  return element;
}
constexpr WireField array_of(WireField element, int fixed_count) {
  element.fixed_count = fixed_count;
  return element;
}
constexpr WireField any_int64(std::string_view name) {
  return {name, WireKind::kInt64, std::numeric_limits<std::int64_t>::min(), kMostInt64, {}, 1};
}

// Names of the constants in lcmtypes.
constexpr std::array<std::string_view, 3> kTrackStates{"searching", "tracking", "lost"};
constexpr std::array<std::string_view, 3> kValidities{"none", "coasting", "tracked"};
constexpr std::array<std::string_view, 4> kArmModes{"follow", "hold", "stop", "reset"};
constexpr std::array<std::string_view, 5> kArmStates{"idle", "moving", "holding", "stopped",
                                                     "fault"};
constexpr std::array<std::string_view, 6> kGamePhases{"waiting", "rally",      "shot at robot",
                                                      "goal",    "puck stuck", "puck out of view"};
constexpr std::array<std::string_view, 5> kServiceStates{"starting", "running", "waiting",
                                                         "degraded", "stopping"};

constexpr WireField kUtime = amount("utime");
constexpr WireField kSession{"session", WireKind::kInt64, 1, kMostInt64, {}, 1};
constexpr WireField kSeq = amount("seq");

constexpr std::array kEventPacket{
    kUtime,
    kSession,
    kSeq,
    whole32("width", 1, 2048),
    whole32("height", 1, 2048),
    // Leaves room for the time of the last event, which an estimate contains.
    WireField{"first_event_us", WireKind::kInt64, 0, kMostOnWire - kLongestPacket_us, {}, 1},
    WireField{"duration_us", WireKind::kInt64, 0, kLongestPacket_us, {}, 1},
    amount("sensor_zero_utime"),
    amount("events_before"),
    amount("events_dropped"),
    truth_value("recorded"),
    whole32("encoding", 1, 3),
    whole32("count", 0, kMaxEventsInPacket),
    whole32("size", 0, 4 * kMaxEventsInPacket),
    array_of(WireField{"data", WireKind::kByte, 0, 255, {}, 1}, "size"),
};

constexpr std::array kPuckEstimate{
    kUtime,
    kSession,
    kSeq,
    reference("events_session"),
    amount("sensor_us"),
    amount("events_applied"),
    amount("event_utime"),
    amount("packet_received_utime"),
    amount("tracking_started_utime"),
    amount("backlog_us"),
    amount("backlog_events"),
    one_of("state", kTrackStates),
    whole32("flags", 0, 31),
    real("x_px"),
    real("y_px"),
    real("vx_px_s"),
    real("vy_px_s"),
    real("width_px"),
    real("height_px"),
    real("score"),
    array_of(real("covariance"), 16),
    real("left_x_px"),
    real("left_y_px"),
    whole32("region_x", -kMostInt32, kMostInt32),
    whole32("region_y", -kMostInt32, kMostInt32),
    whole32("region_width", 0, kMostInt32),
    whole32("region_height", 0, kMostInt32),
    whole32("image_width", 0, 2048),
    whole32("image_height", 0, 2048),
    amount("packets_received"),
    amount("packets_lost"),
    amount("packets_late"),
    amount("packets_rejected"),
    amount("events_lost"),
    amount("events_skipped"),
    amount("events_dropped"),
};

constexpr std::array kPuckTrajectory{
    kUtime,
    kSession,
    kSeq,
    reference("estimate_session"),
    amount("estimate_seq"),
    amount("sensor_us"),
    one_of("validity", kValidities),
    truth_value("head_known"),
    real("x_m"),
    real("y_m"),
    real("vx_m_s"),
    real("vy_m_s"),
    array_of(real("covariance"), 16),
    whole32("path_length", 0, kMaxPath),
    array_of(real("path_t_s"), "path_length"),
    array_of(real("path_x_m"), "path_length"),
    array_of(real("path_y_m"), "path_length"),
    truth_value("crosses"),
    real("line_x_m"),
    real("crossing_y_m"),
    real("crossing_in_s"),
    real("crossing_sigma_y_m"),
    real("crossing_sigma_t_s"),
    real("crossing_speed_m_s"),
    whole32("crossing_bounces", 0, kMostInt32),
};

constexpr std::array kArmCommand{
    kUtime,
    kSession,
    kSeq,
    one_of("mode", kArmModes),
    truth_value("from_operator"),
    real("target_m"),
    real("target_normalised"),
    amount("arrive_in_us"),
    amount("valid_for_us"),
    reference("estimate_session"),
    amount("estimate_seq"),
    reference("arm_session"),
};

constexpr std::array kArmState{
    kUtime,
    kSession,
    kSeq,
    one_of("state", kArmStates),
    text("reason"),
    whole32("faults", 0, kMostInt32),
    text("back_end"),
    real("line_x_m"),
    real("line_min_m"),
    real("line_max_m"),
    real("position_m"),
    real("position_normalised"),
    real("velocity_m_s"),
    real("target_m"),
    whole32("joint_count", 0, kMaxJoints),
    array_of(real("joint_deg"), "joint_count"),
    array_of(real("joint_velocity_deg_s"), "joint_count"),
    reference("command_session"),
    amount("command_seq"),
    reference("estimate_session"),
    amount("estimate_seq"),
    amount("commands_refused"),
    amount("estimate_to_motion_us"),
};

constexpr std::array kGameState{
    kUtime,
    kSession,
    kSeq,
    amount("sensor_us"),
    one_of("phase", kGamePhases),
    amount("phase_since_us"),
    whole32("goals_for", 0, kMostInt32),
    whole32("goals_against", 0, kMostInt32),
    whole32("rally_hits", 0, kMostInt32),
    whole32("longest_rally", 0, kMostInt32),
    whole32("shots", 0, kMostInt32),
    whole32("saves", 0, kMostInt32),
};

constexpr std::array kHeadState{
    kUtime,
    kSession,
    kSeq,
    WireField{"sensor_us", WireKind::kInt64, -1, kMostOnWire, {}, 1},
    real("yaw_deg"),
    real("pitch_deg"),
    real("roll_deg"),
    real("yaw_deg_s"),
    real("pitch_deg_s"),
    real("roll_deg_s"),
};

constexpr std::array kGroundTruth{
    kUtime,
    kSession,
    kSeq,
    amount("sensor_us"),
    real("x_px"),
    real("y_px"),
    real("width_px"),
    real("height_px"),
    real("visible"),
    truth_value("in_play"),
    real("x_m"),
    real("y_m"),
    real("vx_m_s"),
    real("vy_m_s"),
    whole32("shots", 0, kMostInt32),
    whole32("saves", 0, kMostInt32),
    whole32("goals_against", 0, kMostInt32),
    whole32("goals_for", 0, kMostInt32),
};

constexpr std::array kServiceStatus{
    kUtime,
    kSession,
    kSeq,
    text("service"),
    text("host"),
    whole32("pid", 0, kMostInt32),
    text("version"),
    one_of("state", kServiceStates),
    text("state_text"),
    amount("uptime_us"),
    whole32("counter_count", 0, kMaxCounters),
    array_of(text("counter_name"), "counter_count"),
    array_of(any_int64("counter_value"), "counter_count"),
    whole32("latency_count", 0, kMaxLatencies),
    array_of(text("latency_name"), "latency_count"),
    array_of(any_int64("latency_p50_us"), "latency_count"),
    array_of(any_int64("latency_p99_us"), "latency_count"),
    array_of(any_int64("latency_max_us"), "latency_count"),
    array_of(amount("latency_samples"), "latency_count"),
    whole32("pong_count", 0, kMaxPongs),
    array_of(reference("pong_session"), "pong_count"),
    array_of(amount("pong_utime"), "pong_count"),
    array_of(amount("pong_received_utime"), "pong_count"),
};

// In the order of enum Channel.
constexpr std::array kLayouts{
    WireLayout{"event_packet_t", &event_packet_t::getHash, kEventPacket},
    WireLayout{"puck_estimate_t", &puck_estimate_t::getHash, kPuckEstimate},
    WireLayout{"puck_trajectory_t", &puck_trajectory_t::getHash, kPuckTrajectory},
    WireLayout{"arm_command_t", &arm_command_t::getHash, kArmCommand},
    WireLayout{"arm_state_t", &arm_state_t::getHash, kArmState},
    WireLayout{"game_state_t", &game_state_t::getHash, kGameState},
    WireLayout{"head_state_t", &head_state_t::getHash, kHeadState},
    WireLayout{"ground_truth_t", &ground_truth_t::getHash, kGroundTruth},
    WireLayout{"service_status_t", &service_status_t::getHash, kServiceStatus},
};
static_assert(kLayouts.size() == kAllChannels.size());

std::size_t most_count(const WireLayout& layout, const WireField& field) {
  const auto place = place_of_count(layout, field);
  return static_cast<std::size_t>(place ? layout.fields[*place].max : field.fixed_count);
}

}  // namespace

std::optional<std::size_t> place_of_count(const WireLayout& layout, const WireField& field) {
  if (field.count_field.empty()) return std::nullopt;
  const auto found =
      std::find_if(layout.fields.begin(), layout.fields.end(),
                   [&](const WireField& other) { return other.name == field.count_field; });
  return static_cast<std::size_t>(found - layout.fields.begin());
}

std::size_t wire_bytes(WireKind kind) {
  switch (kind) {
    case WireKind::kInt8:
    case WireKind::kBoolean:
    case WireKind::kByte:
      return 1;
    case WireKind::kInt32:
      return 4;
    case WireKind::kInt64:
    case WireKind::kDouble:
      return 8;
    case WireKind::kString:
      return 5;
  }
  return 0;
}

const WireLayout& wire_layout(Channel channel) {
  return kLayouts[static_cast<std::size_t>(channel)];
}

std::size_t most_message_bytes(Channel channel) {
  const WireLayout& layout = wire_layout(channel);
  std::size_t bytes = kFingerprintBytes;
  for (const WireField& field : layout.fields) {
    const std::size_t text =
        field.kind == WireKind::kString ? static_cast<std::size_t>(field.max) : 0;
    bytes += most_count(layout, field) * (wire_bytes(field.kind) + text);
  }
  return bytes;
}

}  // namespace puck
