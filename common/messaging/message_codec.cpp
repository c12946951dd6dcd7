#include "common/messaging/message_codec.h"

#include <limits>

namespace puck {
namespace {

template <typename... Array>
std::int32_t cut_to_shortest(Array&... arrays) {
  const std::size_t shortest = std::min(
      {static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()), arrays.size()...});
  (arrays.resize(shortest), ...);
  return static_cast<std::int32_t>(shortest);
}

}  // namespace

void set_counts(event_packet_t& message) { message.size = cut_to_shortest(message.data); }

void set_counts(puck_trajectory_t& message) {
  message.path_length = cut_to_shortest(message.path_t_s, message.path_x_m, message.path_y_m);
}

void set_counts(arm_state_t& message) {
  message.joint_count = cut_to_shortest(message.joint_deg, message.joint_velocity_deg_s);
}

void set_counts(service_status_t& message) {
  message.counter_count = cut_to_shortest(message.counter_name, message.counter_value);
  message.latency_count =
      cut_to_shortest(message.latency_name, message.latency_p50_us, message.latency_p99_us,
                      message.latency_max_us, message.latency_samples);
  message.pong_count =
      cut_to_shortest(message.pong_session, message.pong_utime, message.pong_received_utime);
}

}  // namespace puck
