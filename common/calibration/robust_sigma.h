#pragma once

namespace puck {

/// Ratio of a normal distribution's standard deviation to its median absolute deviation.
inline constexpr double kSigmaOfMedian = 1.4826;

}  // namespace puck
