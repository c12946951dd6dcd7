#pragma once

#include <string>

namespace puck {

/// `2.5 deg`, with up to six digits.
std::string in_deg(double value);

}  // namespace puck
