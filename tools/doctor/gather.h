#pragma once

#include "tools/doctor/facts.h"
#include "tools/doctor/settings.h"

namespace puck {

/// Reads the machine's state and listens on the bus. Unreadable facts stay empty.
Facts gather(const DoctorSettings& settings);

}  // namespace puck
