#pragma once

namespace puck {

/// Up to here a time is exact to the µs in a double: 285 years.
inline constexpr double kLatestUs = 9.0e15;
/// Of a puck in an image.
inline constexpr double kLargestSizePx = 1e4;
/// Either way, of a joint's angle.
inline constexpr double kMostJointDeg = 720;

}  // namespace puck
