#pragma once

#include <span>

#include "common/yarp/little_endian.h"

namespace puck {

/// Set-points of all joints of a part, deg, in mode `posd`: what a message to command:i carries.
Bytes set_points_of_all(std::span<const double> deg);

/// The same of some of the joints only. The board takes a list that is missing, or not of this
/// size, so badly that it dies: both spans are of one size.
Bytes set_points_of_some(std::span<const int> joints, std::span<const double> deg);

}  // namespace puck
