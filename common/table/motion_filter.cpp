#include "common/table/motion_filter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

// A puck at rest may still creep with the air, m/s.
constexpr double kRestingSpeedSigma = 0.01;
// How far from where it must be a puck may seem to be that has just been hit, m.
constexpr double kNear = 0.03;

PuckTrack at_rest(const PuckTrack& track) {
  const double speed = kRestingSpeedSigma * kRestingSpeedSigma;
  const Matrix4& p = track.covariance;
  return {{track.state.position, {}},
          {p[0], p[1], 0, 0, p[4], p[5], 0, 0, 0, 0, speed, 0, 0, 0, 0, speed}};
}

double distance_m(const TablePoint& a, const TablePoint& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

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
  before_.hits = current().hits;
  before_.jumps = current().jumps;
  before_.newest.reset();
  before_.doubt.reset();
  before_.trail.clear();
  before_.newest_seen = {};
  count_ = 0;
}

MeasurementUse MotionFilter::update(const TableMeasurement& m) {
  if (!is_usable(m)) return MeasurementUse::kRejected;
  const auto end = moments_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto place =
      std::upper_bound(moments_.begin(), end, m.t,
                       [](Timestamp t, const Moment& moment) { return t < moment.measurement.t; });
  auto index = static_cast<std::size_t>(place - moments_.begin());
  if (index > 0 && moments_[index - 1].measurement.t == m.t) {
    // A puck at rest makes no events, so that time stands still with it.
    Moment& same = moments_[index - 1];
    if (!m.resting || index != count_ || !is_good(same.use)) return MeasurementUse::kLate;
    same.measurement.resting = true;
    filter_from(index - 1);
    return MeasurementUse::kUsed;
  }
  const bool is_after_all_forgotten = m.t > before_.newest_seen || !before_.newest;
  if (index == 0 && !is_after_all_forgotten) return MeasurementUse::kLate;
  if (count_ == kHistory) {
    if (index == 0) return MeasurementUse::kLate;
    before_ = moments_.front().after;
    std::move(moments_.begin() + 1, moments_.end(), moments_.begin());
    --count_;
    --index;
  }
  std::move_backward(moments_.begin() + static_cast<std::ptrdiff_t>(index),
                     moments_.begin() + static_cast<std::ptrdiff_t>(count_),
                     moments_.begin() + static_cast<std::ptrdiff_t>(count_ + 1));
  ++count_;
  moments_[index].measurement = m;
  filter_from(index);
  return moments_[index].use;
}

void MotionFilter::filter_from(std::size_t index) {
  for (std::size_t i = index; i < count_; ++i) {
    moments_[i].after = i > 0 ? moments_[i - 1].after : before_;
    moments_[i].use = filter(moments_[i].after, moments_[i].measurement);
  }
}

MeasurementUse MotionFilter::filter(Belief& belief, const TableMeasurement& m) const {
  const std::int64_t since_last_us = belief.newest ? m.t - belief.newest_seen : 0;
  belief.newest_seen = m.t;
  if (!belief.newest || m.t - *belief.newest > params_.max_coast_us) {
    belief.track = begun(m, noise_of(m, 1));
    belief.newest = m.t;
    belief.doubt.reset();
    belief.trail.clear();
    return MeasurementUse::kStarted;
  }
  const double shared =
      std::max(1.0, static_cast<double>(params_.error_memory_us) /
                        static_cast<double>(std::max<std::int64_t>(since_last_us, 1)));
  const PuckTrack expected = predicted(belief.track, *belief.newest, m.t);
  if (!is_within(expected, m.position, noise_of(m, 1), params_.gate_sigmas)) {
    return follow_doubt(belief, m, shared);
  }
  const PuckTrack track = with_measurement(expected, m.position, noise_of(m, shared));
  belief.track = m.resting ? at_rest(track) : track;
  belief.newest = m.t;
  belief.doubt.reset();
  belief.trail.add(m.t, belief.track.state);
  return MeasurementUse::kUsed;
}

MeasurementUse MotionFilter::follow_doubt(Belief& belief, const TableMeasurement& m,
                                          double shared) const {
  std::optional<Doubt>& doubt = belief.doubt;
  const PuckTrack expected = doubt ? predicted(doubt->track, doubt->newest, m.t) : PuckTrack{};
  if (doubt && is_within(expected, m.position, noise_of(m, 1), params_.gate_sigmas)) {
    doubt->track = with_measurement(expected, m.position, noise_of(m, shared));
    doubt->newest = m.t;
  } else {
    const double since_s = static_cast<double>(m.t - *belief.newest) * 1e-6;
    const double reach_m = kNear + params_.fastest_m_s * since_s;
    doubt = Doubt{begun(m, noise_of(m, 1)), m.t, m.t,
                  distance_m(belief.track.state.position, m.position) <= reach_m};
  }
  const std::int64_t lasted_us = m.t - doubt->since;
  if (lasted_us < std::min(params_.hit_after_us, params_.jump_after_us)) {
    return MeasurementUse::kOutlier;
  }
  const bool is_hit = doubt->is_near || belief.trail.leads_to(m.t, doubt->track.state);
  if (lasted_us < (is_hit ? params_.hit_after_us : params_.jump_after_us)) {
    return MeasurementUse::kOutlier;
  }
  const MeasurementUse use = is_hit ? MeasurementUse::kHit : MeasurementUse::kJumped;
  ++(is_hit ? belief.hits : belief.jumps);
  belief.track = m.resting ? at_rest(doubt->track) : doubt->track;
  belief.newest = m.t;
  if (!is_hit) belief.trail.clear();
  doubt.reset();
  return use;
}

PuckTrack MotionFilter::begun(const TableMeasurement& m, const Matrix2& noise) const {
  const double speed = params_.initial_speed_sigma_m_s * params_.initial_speed_sigma_m_s;
  const Matrix2& v = m.velocity_covariance;
  const double cross = (v[1] + v[2]) / 2;
  const PuckTrack track{{m.position, m.velocity},
                        {noise[0], noise[1], 0, 0, noise[2], noise[3], 0, 0, 0, 0, v[0] + speed,
                         cross, 0, 0, cross, v[3] + speed}};
  return m.resting ? at_rest(track) : track;
}

Matrix2 MotionFilter::noise_of(const TableMeasurement& m, double shared) const {
  const double floor = params_.position_sigma_m * params_.position_sigma_m;
  const double cross = shared * (m.covariance[1] + m.covariance[2]) / 2;
  return {shared * m.covariance[0] + floor, cross, cross, shared * m.covariance[3] + floor};
}

PuckTrack MotionFilter::predicted(const PuckTrack& track, Timestamp from, Timestamp to) const {
  return motion_.advance(track, static_cast<double>(to - from) * 1e-6).track;
}

std::optional<PuckTrack> MotionFilter::at(Timestamp t) const {
  const Belief& belief = current();
  if (!belief.newest || t < *belief.newest || t - *belief.newest > params_.max_coast_us) {
    return std::nullopt;
  }
  PuckTrack track = predicted(belief.track, *belief.newest, t);
  // What the tracker does not know of stays, however many measurements are taken in.
  const double floor = params_.position_sigma_m * params_.position_sigma_m;
  track.covariance[0] += floor;
  track.covariance[5] += floor;
  return track;
}

}  // namespace puck
