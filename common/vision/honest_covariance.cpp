#include "common/vision/honest_covariance.h"

#include <algorithm>

namespace puck {
namespace {

constexpr double kLagSigma_s = 80e-6;
constexpr double kFloor_px = 0.04;

}  // namespace

std::array<double, 16> honest_covariance(const ContourFilter& filter,
                                         const PuckSignature& signature) {
  const double share =
      signature.knows_multiplicity() ? 1 / std::max(signature.multiplicity(), 1.0) : 1;
  std::array<double, 16> covariance = filter.covariance();
  for (double& value : covariance) value *= share;
  const double lag_x = kLagSigma_s * filter.velocity().x;
  const double lag_y = kLagSigma_s * filter.velocity().y;
  covariance[0] += lag_x * lag_x + kFloor_px * kFloor_px;
  covariance[1] += lag_x * lag_y;
  covariance[4] += lag_x * lag_y;
  covariance[5] += lag_y * lag_y + kFloor_px * kFloor_px;
  return covariance;
}

}  // namespace puck
