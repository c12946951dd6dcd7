#pragma once

#include <span>

#include "common/events/event.h"

namespace puck {

/// Whether the offsets of a packet's events never go back. Vectorised; every instruction set gives
/// the same answer.
bool are_sorted(std::span<const Event> events);

}  // namespace puck
