#include "common/table/kalman_step.h"

#include <cmath>

#include <Eigen/LU>

namespace puck {
namespace {

Eigen::Vector2d from_to(const TablePoint& from, const TablePoint& to) {
  return {to.x_m - from.x_m, to.y_m - from.y_m};
}

}  // namespace

bool is_usable(const TableMeasurement& m) {
  for (const double value : {m.position.x_m, m.position.y_m, m.velocity.x_m_s, m.velocity.y_m_s}) {
    if (!std::isfinite(value)) return false;
  }
  const Matrix2& c = m.covariance;
  return c.allFinite() && m.velocity_covariance.allFinite() && c.diagonal().minCoeff() >= 0 &&
         c(0, 1) * c(1, 0) <= c(0, 0) * c(1, 1) * (1 + 1e-9) &&
         m.velocity_covariance.diagonal().minCoeff() >= 0;
}

bool is_within(const PuckTrack& predicted, const TablePoint& place, const Matrix2& noise,
               double sigmas) {
  const Matrix2 innovation = predicted.covariance.topLeftCorner<2, 2>() + noise;
  const Eigen::Vector2d off = from_to(predicted.state.position, place);
  return off.dot(innovation.inverse() * off) <= sigmas * sigmas;
}

PuckTrack with_measurement(const PuckTrack& predicted, const TablePoint& place,
                           const Matrix2& noise) {
  const Matrix4& p = predicted.covariance;
  const Matrix2 innovation = p.topLeftCorner<2, 2>() + noise;
  const Eigen::Matrix<double, 4, 2> gain = p.leftCols<2>() * innovation.inverse();
  // Joseph form: the covariance stays positive despite rounding.
  Matrix4 keep = Matrix4::Identity();
  keep.leftCols<2>() -= gain;
  PuckTrack track;
  track.covariance = symmetric_part(carried(keep, p) + gain * noise * gain.transpose());
  const Eigen::Vector4d step = gain * from_to(predicted.state.position, place);
  const auto& [position, velocity] = predicted.state;
  track.state.position = {position.x_m + step(0), position.y_m + step(1)};
  track.state.velocity = {velocity.x_m_s + step(2), velocity.y_m_s + step(3)};
  return track;
}

}  // namespace puck
