#include "common/table/kalman_step.h"

#include <cmath>
#include <cstddef>

namespace puck {
namespace {

// Inverse of the innovation's covariance: position covariance plus noise.
Matrix2 inverse_of_sum(const Matrix4& p, const Matrix2& r) {
  const Matrix2 s{p[0] + r[0], p[1] + r[1], p[4] + r[2], p[5] + r[3]};
  const double determinant = s[0] * s[3] - s[1] * s[2];
  return {s[3] / determinant, -s[1] / determinant, -s[2] / determinant, s[0] / determinant};
}

}  // namespace

bool is_usable(const TableMeasurement& m) {
  for (const double value : {m.position.x_m, m.position.y_m, m.velocity.x_m_s, m.velocity.y_m_s}) {
    if (!std::isfinite(value)) return false;
  }
  for (const Matrix2& covariance : {m.covariance, m.velocity_covariance}) {
    for (const double element : covariance) {
      if (!std::isfinite(element)) return false;
    }
  }
  const Matrix2& c = m.covariance;
  return c[0] >= 0 && c[3] >= 0 && c[1] * c[2] <= c[0] * c[3] * (1 + 1e-9) &&
         m.velocity_covariance[0] >= 0 && m.velocity_covariance[3] >= 0;
}

bool is_within(const PuckTrack& predicted, const TablePoint& place, const Matrix2& noise,
               double sigmas) {
  const Matrix2 weight = inverse_of_sum(predicted.covariance, noise);
  const double dx = place.x_m - predicted.state.position.x_m;
  const double dy = place.y_m - predicted.state.position.y_m;
  const double distance_squared =
      dx * (weight[0] * dx + weight[1] * dy) + dy * (weight[2] * dx + weight[3] * dy);
  return distance_squared <= sigmas * sigmas;
}

PuckTrack with_measurement(const PuckTrack& predicted, const TablePoint& place,
                           const Matrix2& noise) {
  const Matrix4& p = predicted.covariance;
  const Matrix2& r = noise;
  const Matrix2 inverse = inverse_of_sum(p, r);
  const double dx = place.x_m - predicted.state.position.x_m;
  const double dy = place.y_m - predicted.state.position.y_m;

  std::array<double, 8> gain{};  // 4 × 2: P Hᵀ S⁻¹
  for (std::size_t row = 0; row < 4; ++row) {
    const double px = p[4 * row];
    const double py = p[4 * row + 1];
    gain[2 * row] = px * inverse[0] + py * inverse[2];
    gain[2 * row + 1] = px * inverse[1] + py * inverse[3];
  }
  // Joseph form: the covariance stays positive despite rounding.
  Matrix4 keep = diagonal(1, 1, 1, 1);
  Matrix4 gained{};
  for (std::size_t row = 0; row < 4; ++row) {
    keep[4 * row] -= gain[2 * row];
    keep[4 * row + 1] -= gain[2 * row + 1];
    for (std::size_t column = 0; column < 4; ++column) {
      const double a = gain[2 * row] * r[0] + gain[2 * row + 1] * r[2];
      const double b = gain[2 * row] * r[1] + gain[2 * row + 1] * r[3];
      gained[4 * row + column] = a * gain[2 * column] + b * gain[2 * column + 1];
    }
  }
  PuckTrack track;
  track.covariance = symmetric_part(sum(carried(keep, p), gained));
  const auto& [position, velocity] = predicted.state;
  track.state.position = {position.x_m + gain[0] * dx + gain[1] * dy,
                          position.y_m + gain[2] * dx + gain[3] * dy};
  track.state.velocity = {velocity.x_m_s + gain[4] * dx + gain[5] * dy,
                          velocity.y_m_s + gain[6] * dx + gain[7] * dy};
  return track;
}

}  // namespace puck
