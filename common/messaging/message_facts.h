#pragma once

#include <cstdint>

#include "common/messaging/channels.h"

namespace puck {

/// Whether `sensor_us` is possible: no sensor runs for longer than 30 years.
constexpr bool is_sensor_time(std::int64_t sensor_us) {
  constexpr std::int64_t kLongestRunUs = 1'000'000'000'000'000;
  return sensor_us >= 0 && sensor_us <= kLongestRunUs;
}

/// Whether the arm is stopped or at fault: it ignores commands until a reset.
inline bool is_latched(const arm_state_t& state) {
  return state.state == arm_state_t::STATE_STOPPED || state.state == arm_state_t::STATE_FAULT;
}

}  // namespace puck
