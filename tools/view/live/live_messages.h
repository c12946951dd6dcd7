#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/monitor/bus_snapshot.h"
#include "tools/view/interface/view_state.h"

namespace puck {

/// What a viewer of the live bus knows beside the traffic.
struct LiveFacts {
  std::string network_problem;  ///< Why the bus is not joined yet; empty: it is.
  std::string prefix;
  SensorSize sensor;                       ///< Of the camera; {0, 0}: not known.
  std::optional<SensorSize> other_sensor;  ///< That of the tracker, if it differs.
  std::optional<std::int64_t> events_age_us;
  std::vector<ViewMessage> doctor;  ///< What puck-doctor says.
};

/// What is wrong or missing on the bus, in the order of its weight.
std::vector<ViewMessage> live_messages(const BusSnapshot& snapshot, const LiveFacts& facts);

/// Whether nothing of ours has arrived for so long that the network is in doubt.
bool is_silent(const BusSnapshot& snapshot);

std::vector<ViewService> view_services(const BusSnapshot& snapshot);
std::vector<ViewChannel> view_channels(const BusSnapshot& snapshot);

}  // namespace puck
