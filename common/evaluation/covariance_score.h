#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/vision/interfaces/puck_estimate.h"

namespace puck {

/// Consistency of the estimates' covariances with their errors. The normalised estimation error
/// squared (NEES) of a position is e' P⁻¹ e. For a consistent P it has a chi² distribution with two
/// degrees of freedom: mean 2, median 1.39, 95 % within 5.99. A larger mean: the covariances are
/// too small.
struct CovarianceReport {
  std::int64_t estimates = 0;  ///< Ticks that count, were tracked and had a covariance.
  double nees_mean = 0;        ///< Of the invertible covariances.
  double nees_median = 0;
  double nees_within_95_percent = 0;  ///< A singular covariance counts as outside.
};

/// The 95 % bound of chi² with two degrees of freedom.
inline constexpr double kNeesBound95 = 5.991;

/// NEES of an estimate's position. `std::nullopt` without a position, unless the state is
/// `tracking`, and where the covariance of the position is all zeros (absent). Infinite where it is
/// not positive definite.
std::optional<double> normalised_error_squared(const PuckEstimate& estimate, Pixel truth);

/// `std::nullopt` when there are no values.
std::optional<CovarianceReport> covariance_report(std::vector<double> normalised_errors_squared);

}  // namespace puck
