#pragma once

namespace puck {

/// Times up to this are exact to the µs in a double: 285 years.
inline constexpr double kLatestUs = 9.0e15;
/// Limit of a puck's size in an image.
inline constexpr double kLargestSizePx = 1e4;
/// Limit of a joint angle's magnitude.
inline constexpr double kMostJointDeg = 720;

}  // namespace puck
