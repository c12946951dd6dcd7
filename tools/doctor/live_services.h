#pragma once

#include <vector>

#include "tools/doctor/facts.h"

namespace puck {

/// The services under our prefix that still spoke when the listening ended: not those that had
/// stopped or fallen silent meanwhile, and no doctor.
std::vector<const HeardService*> live_services(const Facts& facts);

}  // namespace puck
