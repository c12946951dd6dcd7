#pragma once

#include "tools/doctor/facts.h"

namespace puck {

/// Listens on the bus for `facts.seconds`, sends the doctor's own messages, and fills in the facts
/// of the bus.
void listen(Facts& facts);

}  // namespace puck
