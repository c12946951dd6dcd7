#pragma once

#include <cstdint>
#include <span>

#include "common/io/yarp_packet.h"

namespace puck {

/// Reads a message of an IIT camera's port: a bottle in YARP's binary form, `AE (stamp address …)`
/// or `AE duration bytes`, with records of other sensors before or behind it, which are passed
/// over. Leaves `host_time_s` at 0 and reuses the memory of `packet`. False for anything else, and
/// where the bottle has another length than its items.
bool parse_yarp_bottle(std::span<const std::uint8_t> bytes, YarpPacket& packet);

}  // namespace puck
