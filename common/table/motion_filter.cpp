#include "common/table/motion_filter.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

// Speed of a resting puck that creeps on the air cushion, m/s.
constexpr double kRestingSpeedSigma = 0.01;
// Tolerance of the reachability gate for a puck that was just hit, m.
constexpr double kGateMarginM = 0.03;

PuckTrack at_rest(const PuckTrack& track) {
  const double speed = kRestingSpeedSigma * kRestingSpeedSigma;
  PuckTrack rest{{track.state.position, {}}, diagonal(0, 0, speed, speed)};
  rest.covariance.topLeftCorner<2, 2>() = track.covariance.topLeftCorner<2, 2>();
  return rest;
}

double distance_m(const TablePoint& a, const TablePoint& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

}  // namespace

MotionFilter::MotionFilter(const PuckMotion& motion, const MotionFilterParams& params)
    : motion_(motion), params_(params) {
  std::iota(order_.begin(), order_.end(), 0);
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
  require(params_.hit_after_us >= 0 && params_.hit_after_us <= 1'000'000,
          "filter.hit_after_us must be between 0 and 1000000");
  require(params_.jump_after_us >= 0 && params_.jump_after_us <= 1'000'000,
          "filter.jump_after_us must be between 0 and 1000000");
  require(params_.fastest_m_s > 0 && params_.fastest_m_s <= 100,
          "filter.fastest_m_s must be above 0 and at most 100");
  require(params_.max_coast_us > 0 && params_.max_coast_us <= 1'000'000,
          "filter.max_coast_us must be above 0 and at most 1000000");
}

void MotionFilter::reset() {
  before_history_.hits = current().hits;
  before_history_.jumps = current().jumps;
  before_history_.newest.reset();
  before_history_.tentative.reset();
  before_history_.trail.clear();
  before_history_.newest_seen = {};
  count_ = 0;
}

MeasurementUse MotionFilter::update(const TableMeasurement& m) {
  if (!is_usable(m)) return MeasurementUse::kRejected;
  std::size_t index = count_;
  while (index > 0 && m.t < entry(index - 1).measurement.t) --index;
  if (index > 0 && entry(index - 1).measurement.t == m.t) {
    // Sensor time does not advance for a puck at rest, since it causes no events.
    HistoryEntry& same = entry(index - 1);
    if (!m.resting || index != count_ || !is_good(same.use)) return MeasurementUse::kLate;
    same.measurement.resting = true;
    filter_from(index - 1);
    return MeasurementUse::kUsed;
  }
  const bool is_after_dropped = m.t > before_history_.newest_seen || !before_history_.newest;
  if (index == 0 && !is_after_dropped) return MeasurementUse::kLate;
  if (count_ == kHistory) {
    if (index == 0) return MeasurementUse::kLate;
    before_history_ = entry(0).after;
    std::rotate(order_.begin(), order_.begin() + 1, order_.end());
    --count_;
    --index;
  }
  const auto free = order_.begin() + static_cast<std::ptrdiff_t>(count_);
  std::rotate(order_.begin() + static_cast<std::ptrdiff_t>(index), free, free + 1);
  ++count_;
  entry(index).measurement = m;
  filter_from(index);
  return entry(index).use;
}

void MotionFilter::filter_from(std::size_t index) {
  for (std::size_t i = index; i < count_; ++i) {
    entry(i).after = i > 0 ? entry(i - 1).after : before_history_;
    entry(i).use = filter(entry(i).after, entry(i).measurement);
  }
}

MeasurementUse MotionFilter::filter(FilterState& filtered, const TableMeasurement& m) const {
  const std::int64_t since_last_us = filtered.newest ? m.t - filtered.newest_seen : 0;
  filtered.newest_seen = m.t;
  if (!filtered.newest || m.t - *filtered.newest > params_.max_coast_us) {
    filtered.track = started_track(m, noise_of(m, 1));
    filtered.newest = m.t;
    filtered.tentative.reset();
    filtered.trail.clear();
    return MeasurementUse::kStarted;
  }
  const double shared =
      std::max(1.0, static_cast<double>(params_.error_memory_us) /
                        static_cast<double>(std::max<std::int64_t>(since_last_us, 1)));
  const PuckTrack expected = predicted(filtered.track, *filtered.newest, m.t);
  if (!is_within(expected, m.position, noise_of(m, 1), params_.gate_sigmas)) {
    return update_tentative(filtered, m, shared);
  }
  const PuckTrack track = with_measurement(expected, m.position, noise_of(m, shared));
  filtered.track = m.resting ? at_rest(track) : track;
  filtered.newest = m.t;
  filtered.tentative.reset();
  filtered.trail.add(m.t, filtered.track.state);
  return MeasurementUse::kUsed;
}

MeasurementUse MotionFilter::update_tentative(FilterState& filtered, const TableMeasurement& m,
                                              double shared) const {
  std::optional<TentativeTrack>& tentative = filtered.tentative;
  const PuckTrack expected =
      tentative ? predicted(tentative->track, tentative->newest, m.t) : PuckTrack{};
  if (tentative && is_within(expected, m.position, noise_of(m, 1), params_.gate_sigmas)) {
    tentative->track = with_measurement(expected, m.position, noise_of(m, shared));
    tentative->newest = m.t;
  } else {
    const double since_s = static_cast<double>(m.t - *filtered.newest) * 1e-6;
    const double reach_m = kGateMarginM + params_.fastest_m_s * since_s;
    tentative = TentativeTrack{started_track(m, noise_of(m, 1)), m.t, m.t,
                               distance_m(filtered.track.state.position, m.position) <= reach_m};
  }
  const std::int64_t lasted_us = m.t - tentative->since;
  if (lasted_us < std::min(params_.hit_after_us, params_.jump_after_us)) {
    return MeasurementUse::kOutlier;
  }
  const bool is_hit = tentative->is_near || filtered.trail.leads_to(m.t, tentative->track.state);
  if (lasted_us < (is_hit ? params_.hit_after_us : params_.jump_after_us)) {
    return MeasurementUse::kOutlier;
  }
  const MeasurementUse use = is_hit ? MeasurementUse::kHit : MeasurementUse::kJumped;
  ++(is_hit ? filtered.hits : filtered.jumps);
  filtered.track = m.resting ? at_rest(tentative->track) : tentative->track;
  filtered.newest = m.t;
  if (!is_hit) filtered.trail.clear();
  tentative.reset();
  return use;
}

PuckTrack MotionFilter::started_track(const TableMeasurement& m, const Matrix2& noise) const {
  const double speed = params_.initial_speed_sigma_m_s * params_.initial_speed_sigma_m_s;
  const Matrix2& v = m.velocity_covariance;
  PuckTrack track{{m.position, m.velocity}, diagonal(0, 0, speed, speed)};
  track.covariance.topLeftCorner<2, 2>() = noise;
  track.covariance.bottomRightCorner<2, 2>() += (v + v.transpose()) / 2;
  return m.resting ? at_rest(track) : track;
}

Matrix2 MotionFilter::noise_of(const TableMeasurement& m, double shared) const {
  const double floor = params_.position_sigma_m * params_.position_sigma_m;
  return shared * (m.covariance + m.covariance.transpose()) / 2 + floor * Matrix2::Identity();
}

PuckTrack MotionFilter::predicted(const PuckTrack& track, Timestamp from, Timestamp to) const {
  return motion_.advance(track, static_cast<double>(to - from) * 1e-6).track;
}

std::optional<PuckTrack> MotionFilter::at(Timestamp t) const {
  const FilterState& filtered = current();
  if (!filtered.newest || t < *filtered.newest || t - *filtered.newest > params_.max_coast_us) {
    return std::nullopt;
  }
  PuckTrack track = predicted(filtered.track, *filtered.newest, t);
  // Systematic error, which does not average out.
  const double floor = params_.position_sigma_m * params_.position_sigma_m;
  track.covariance += diagonal(floor, floor, 0, 0);
  return track;
}

}  // namespace puck
