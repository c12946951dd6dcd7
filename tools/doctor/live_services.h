#pragma once

#include <vector>

#include "tools/doctor/facts.h"

namespace puck {

/// The services under our prefix that were alive at the end of listening: neither stopped nor
/// silent, and not a doctor.
std::vector<const HeardService*> live_services(const Facts& facts);

}  // namespace puck
