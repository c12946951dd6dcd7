#include "common/table/motion_filter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

using Matrix2 = std::array<double, 4>;

// A puck at rest may still creep with the air, m/s.
constexpr double kRestingSpeedSigma = 0.01;

bool is_usable(const TableMeasurement& m) {
  for (const double value : {m.position.x_m, m.position.y_m, m.velocity.x_m_s, m.velocity.y_m_s}) {
    if (!std::isfinite(value)) return false;
  }
  for (const double element : m.covariance) {
    if (!std::isfinite(element)) return false;
  }
  const auto& c = m.covariance;
  return c[0] >= 0 && c[3] >= 0 && c[1] * c[2] <= c[0] * c[3] * (1 + 1e-9);
}

double determinant(const Matrix2& m) { return m[0] * m[3] - m[1] * m[2]; }

}  // namespace

MotionFilter::MotionFilter(const PuckMotion& motion, const MotionFilterParams& params)
    : motion_(motion), params_(params) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
  };
  require(params_.position_sigma_m > 0 && params_.position_sigma_m < 1,
          "filter.position_sigma_m must be above 0 and below 1");
  require(params_.error_memory_us >= 0 && params_.error_memory_us <= 1'000'000,
          "filter.error_memory_us must be between 0 and 1000000");
  require(params_.initial_speed_sigma_m_s > 0 && params_.initial_speed_sigma_m_s <= 100,
          "filter.initial_speed_sigma_m_s must be above 0 and at most 100");
  require(params_.gate_sigmas >= 1 && params_.gate_sigmas <= 100,
          "filter.gate_sigmas must be between 1 and 100");
  require(params_.restart_after_us >= 0 && params_.restart_after_us <= 1'000'000,
          "filter.restart_after_us must be between 0 and 1000000");
  require(params_.max_coast_us > 0 && params_.max_coast_us <= 1'000'000,
          "filter.max_coast_us must be above 0 and at most 1000000");
}

void MotionFilter::reset() {
  newest_.reset();
  outliers_since_.reset();
}

void MotionFilter::start(const TableMeasurement& m) {
  track_.state = {m.position, m.velocity};
  const double position = params_.position_sigma_m * params_.position_sigma_m;
  const double speed = params_.initial_speed_sigma_m_s * params_.initial_speed_sigma_m_s;
  track_.covariance =
      diagonal(m.covariance[0] + position, m.covariance[3] + position, speed, speed);
  track_.covariance[1] = m.covariance[1];
  track_.covariance[4] = m.covariance[2];
  newest_ = newest_seen_ = m.t;
  outliers_since_.reset();
  if (m.resting) come_to_rest();
}

void MotionFilter::come_to_rest() {
  const double speed = kRestingSpeedSigma * kRestingSpeedSigma;
  const Matrix4& p = track_.covariance;
  track_.covariance = {p[0], p[1], 0, 0, p[4], p[5], 0, 0, 0, 0, speed, 0, 0, 0, 0, speed};
  track_.state.velocity = {};
}

MeasurementUse MotionFilter::update(const TableMeasurement& m) {
  if (!is_usable(m)) return MeasurementUse::kRejected;
  if (newest_ && m.t <= newest_seen_) {
    // A puck at rest makes no events, so that time stands still with it.
    if (m.resting && m.t == newest_ && !outliers_since_) {
      come_to_rest();
      return MeasurementUse::kUsed;
    }
    return MeasurementUse::kLate;
  }
  if (!newest_ || m.t - *newest_ > params_.max_coast_us) {
    start(m);
    return MeasurementUse::kStarted;
  }

  const std::int64_t since_last_us = m.t - newest_seen_;
  newest_seen_ = m.t;
  const PuckTrack predicted =
      motion_.advance(track_, static_cast<double>(m.t - *newest_) * 1e-6).track;
  const Matrix4& p = predicted.covariance;

  const double shared = std::max(
      1.0, static_cast<double>(params_.error_memory_us) / static_cast<double>(since_last_us));
  const double floor = params_.position_sigma_m * params_.position_sigma_m;
  const Matrix2 r{shared * (m.covariance[0] + floor), shared * m.covariance[1],
                  shared * m.covariance[2], shared * (m.covariance[3] + floor)};
  const Matrix2 s{p[0] + r[0], p[1] + r[1], p[4] + r[2], p[5] + r[3]};
  const double det = determinant(s);
  const Matrix2 inverse{s[3] / det, -s[1] / det, -s[2] / det, s[0] / det};
  const double dx = m.position.x_m - predicted.state.position.x_m;
  const double dy = m.position.y_m - predicted.state.position.y_m;
  const double distance_squared =
      dx * (inverse[0] * dx + inverse[1] * dy) + dy * (inverse[2] * dx + inverse[3] * dy);

  if (!(distance_squared <= params_.gate_sigmas * params_.gate_sigmas)) {
    if (!outliers_since_) outliers_since_ = m.t;
    if (m.t - *outliers_since_ < params_.restart_after_us) return MeasurementUse::kOutlier;
    start(m);
    return MeasurementUse::kStarted;
  }
  outliers_since_.reset();

  std::array<double, 8> gain{};  // four by two: P Hᵀ S⁻¹
  for (std::size_t row = 0; row < 4; ++row) {
    const double px = p[4 * row];
    const double py = p[4 * row + 1];
    gain[2 * row] = px * inverse[0] + py * inverse[2];
    gain[2 * row + 1] = px * inverse[1] + py * inverse[3];
  }
  // Joseph's form keeps the covariance positive whatever the rounding.
  Matrix4 keep = diagonal(1, 1, 1, 1);
  Matrix4 noise{};
  for (std::size_t row = 0; row < 4; ++row) {
    keep[4 * row] -= gain[2 * row];
    keep[4 * row + 1] -= gain[2 * row + 1];
    for (std::size_t column = 0; column < 4; ++column) {
      const double a = gain[2 * row] * r[0] + gain[2 * row + 1] * r[2];
      const double b = gain[2 * row] * r[1] + gain[2 * row + 1] * r[3];
      noise[4 * row + column] = a * gain[2 * column] + b * gain[2 * column + 1];
    }
  }
  track_.covariance = symmetric_part(sum(carried(keep, p), noise));
  track_.state.position = {predicted.state.position.x_m + gain[0] * dx + gain[1] * dy,
                           predicted.state.position.y_m + gain[2] * dx + gain[3] * dy};
  track_.state.velocity = {predicted.state.velocity.x_m_s + gain[4] * dx + gain[5] * dy,
                           predicted.state.velocity.y_m_s + gain[6] * dx + gain[7] * dy};
  newest_ = m.t;
  if (m.resting) come_to_rest();
  return MeasurementUse::kUsed;
}

std::optional<PuckTrack> MotionFilter::at(Timestamp t) const {
  if (!newest_ || t < *newest_ || t - *newest_ > params_.max_coast_us) return std::nullopt;
  return motion_.advance(track_, static_cast<double>(t - *newest_) * 1e-6).track;
}

}  // namespace puck
