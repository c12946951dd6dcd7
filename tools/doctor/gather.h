#pragma once

#include "tools/doctor/facts.h"
#include "tools/doctor/settings.h"

namespace puck {

/// Reads the machine and listens on the bus. What cannot be read is left out.
Facts gather(const DoctorSettings& settings);

}  // namespace puck
