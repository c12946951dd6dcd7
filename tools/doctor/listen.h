#pragma once

#include "tools/doctor/facts.h"

namespace puck {

/// Listens on the bus for `facts.seconds`, says what the doctor has to say meanwhile, and fills in
/// what was heard.
void listen(Facts& facts);

}  // namespace puck
