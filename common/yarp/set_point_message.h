#pragma once

#include <span>

#include "common/yarp/little_endian.h"

namespace puck {

/// Payload of a message to command:i: set-points of all joints of a part, deg, in mode `posd`.
Bytes set_points_of_all(std::span<const double> deg);

/// The same for some of the joints. Both spans must have the same size: a board crashes on a
/// missing list or a list of another size.
Bytes set_points_of_some(std::span<const int> joints, std::span<const double> deg);

}  // namespace puck
