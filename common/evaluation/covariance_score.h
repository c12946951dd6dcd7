#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/vision/puck_estimate.h"

namespace puck {

/// How the covariances of the estimates go with their errors. The normalised error squared (NEES)
/// of a position is e' P⁻¹ e; where P is honest it is distributed as chi² with two degrees of
/// freedom: mean 2, median 1.39, and 95 % of it within 5.99. A larger mean: too sure of itself.
struct CovarianceReport {
  std::int64_t estimates = 0;  ///< Ticks that count, were tracked and had a covariance.
  double nees_mean = 0;        ///< Of those with a covariance that can be inverted.
  double nees_median = 0;
  double nees_within_95_percent = 0;  ///< One that cannot be inverted is not within.
};

/// The 95 % bound of chi² with two degrees of freedom.
inline constexpr double kNeesBound95 = 5.991;

/// Normalised error squared of an estimate's position. Nothing without a position, unless it is
/// `tracking`, and where the covariance of the position is all zeros: there is none. Infinite where
/// it is not positive definite.
std::optional<double> normalised_error_squared(const PuckEstimate& estimate, Pixel truth);

/// Nothing when there are no values.
std::optional<CovarianceReport> covariance_report(std::vector<double> normalised_errors_squared);

}  // namespace puck
