#pragma once

namespace puck {

/// Of a normal distribution: standard deviation over median absolute deviation.
inline constexpr double kSigmaOfMedian = 1.4826;

}  // namespace puck
