#include "common/play/track_probation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

// After a longer gap, the next puck may be another one.
constexpr std::int64_t kGapUs = 100'000;
constexpr double kLeapM = 0.05;  // tolerance for errors of estimates
// Memory of the share of outliers. A hit causes 5 ms of outliers.
constexpr double kScatterMemoryUs = 50'000;
constexpr std::int64_t kLongestStepUs = 5'000;
constexpr double kScattered = 0.35;
constexpr double kGathered = 0.15;
// A tracker's velocity lags behind a hit by less than this.
constexpr std::int64_t kContradictionUs = 30'000;
constexpr double kVelocityErrorMS = 1.0;
constexpr double kVelocityErrorShare = 0.5;
// A track with a larger uncertainty of its velocity is not compared, m²/s².
constexpr double kKnownSpeedVariance = 0.1;

double distance(const TablePoint& a, const TablePoint& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

}  // namespace

const char* to_string(TrackProbation::Doubt doubt) {
  switch (doubt) {
    case TrackProbation::Doubt::kNone:
      return "none";
    case TrackProbation::Doubt::kNew:
      return "new";
    case TrackProbation::Doubt::kScattered:
      return "scattered";
    case TrackProbation::Doubt::kContradicts:
      return "contradicts";
  }
  return "unknown";
}

TrackProbation::TrackProbation(const TrackProbationParams& params) : params_(params) {
  if (params_.probation_us < 0 || params_.probation_us > 1'000'000) {
    throw std::invalid_argument("bridge.probation_ms must be between 0 and 1000, got " +
                                std::to_string(params_.probation_us / 1000));
  }
}

void TrackProbation::forget() {
  newest_.reset();
  newest_good_.reset();
  contradicts_since_.reset();
  contradicts_ = false;
}

TrackProbation::Doubt TrackProbation::doubt() const {
  if (!newest_good_ || newest_good_->t - began_ < params_.probation_us) return Doubt::kNew;
  if (contradicts_) return Doubt::kContradicts;
  if (is_scattered_) return Doubt::kScattered;
  return Doubt::kNone;
}

// Whether a track that starts again can be the same puck after a hit.
bool TrackProbation::continues(const TableMeasurement& start) const {
  if (!newest_good_) return false;
  const std::int64_t gap_us = start.t - newest_good_->t;
  if (gap_us > kGapUs) return false;
  const double reach_m = params_.max_speed_m_s * static_cast<double>(gap_us) * 1e-6 + kLeapM;
  return distance(start.position, newest_good_->position) <= reach_m;
}

void TrackProbation::follow_scatter(Timestamp t, bool is_outlier) {
  // The first measurement after a gap counts for kLongestStepUs only.
  const std::int64_t since_us = newest_ ? t - *newest_ : kLongestStepUs;
  const auto elapsed_us =
      static_cast<double>(std::clamp<std::int64_t>(since_us, 0, kLongestStepUs));
  const double kept = std::exp(-elapsed_us / kScatterMemoryUs);
  outlier_share_ = kept * outlier_share_ + (is_outlier ? 1 - kept : 0);
  if (outlier_share_ > kScattered) is_scattered_ = true;
  if (outlier_share_ < kGathered) is_scattered_ = false;
}

void TrackProbation::follow_velocity(const TableMeasurement& measurement, const PuckTrack& track) {
  const TableVelocity& said = measurement.velocity;
  const TableVelocity& found = track.state.velocity;
  // Exactly 0 means that the tracker gives no velocity.
  const bool is_said = said.x_m_s != 0 || said.y_m_s != 0;
  const bool is_found = largest_speed_variance(track) < kKnownSpeedVariance;
  const double speed_m_s =
      std::max(std::hypot(said.x_m_s, said.y_m_s), std::hypot(found.x_m_s, found.y_m_s));
  const double error_m_s = std::hypot(said.x_m_s - found.x_m_s, said.y_m_s - found.y_m_s);
  if (!is_said || !is_found || error_m_s <= kVelocityErrorMS + kVelocityErrorShare * speed_m_s) {
    contradicts_since_.reset();
    if (contradicts_) began_ = measurement.t;
    contradicts_ = false;
    return;
  }
  if (!contradicts_since_) contradicts_since_ = measurement.t;
  if (contradicts_ || measurement.t - *contradicts_since_ < kContradictionUs) return;
  contradicts_ = true;
  ++contradictions_;
}

void TrackProbation::take(const TableMeasurement& measurement, MeasurementUse use,
                          const std::optional<PuckTrack>& track) {
  if (use == MeasurementUse::kLate || use == MeasurementUse::kRejected) return;
  follow_scatter(measurement.t, use == MeasurementUse::kOutlier);
  newest_ = measurement.t;
  if (use == MeasurementUse::kOutlier) return;
  const bool goes_on = use == MeasurementUse::kUsed || use == MeasurementUse::kHit;
  if (!goes_on && !continues(measurement)) {
    if (newest_good_ && measurement.t - newest_good_->t <= kGapUs) ++leaps_;
    began_ = measurement.t;
    contradicts_since_.reset();
    contradicts_ = false;
  }
  newest_good_ = measurement;
  if (track) follow_velocity(measurement, *track);
}

}  // namespace puck
