#include "common/evaluation/accuracy_score.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/evaluation/quantile.h"

namespace puck {
namespace {

constexpr double kNoPositionPx = 100;
constexpr double kLostPx = 20;
constexpr double kLeastVisible = 0.5;
constexpr std::int64_t kSettlingUs = 200'000;

double error_of(const PuckEstimate& estimate, Pixel truth) {
  if (!estimate.position) return kNoPositionPx;
  return std::hypot(estimate.position->x - truth.x, estimate.position->y - truth.y);
}

bool in_image(Pixel centre, SensorSize sensor) {
  return centre.x >= 0 && centre.x <= sensor.width - 1 && centre.y >= 0 &&
         centre.y <= sensor.height - 1;
}

double percent_within(const std::vector<double>& sorted, double limit_px) {
  const auto beyond = std::upper_bound(sorted.begin(), sorted.end(), limit_px);
  return 100 * static_cast<double>(beyond - sorted.begin()) / static_cast<double>(sorted.size());
}

}  // namespace

AccuracyScore::AccuracyScore(TruthTrack truth, SensorSize sensor)
    : truth_(std::move(truth)),
      sensor_(sensor),
      motion_(truth_.first_motion().value_or(truth_.first())) {}

void AccuracyScore::add(Timestamp tick, const PuckEstimate& estimate) {
  const std::optional<TruthRow> truth = truth_.at(tick);
  if (!truth || !in_image(truth->centre, sensor_) || truth->visible < kLeastVisible) {
    lost_since_.reset();
    return;
  }
  const double error_px = error_of(estimate, truth->centre);
  const bool lost = error_px > kLostPx || estimate.state != TrackState::kTracking;
  if (!lost && !first_track_) first_track_ = tick;
  if (tick - motion_ < kSettlingUs) return;

  samples_.push_back(
      {tick, error_px, estimate.score, normalised_error_squared(estimate, truth->centre)});
  if (lost_since_) loss_us_ += tick - *lost_since_;
  longest_loss_us_ = std::max(longest_loss_us_, loss_us_);
  if (lost) {
    ++lost_ticks_;
    lost_since_ = tick;
  } else {
    loss_us_ = 0;
    lost_since_.reset();
  }
}

AccuracyReport AccuracyScore::report() const {
  AccuracyReport report;
  report.estimates = static_cast<std::int64_t>(samples_.size());
  if (first_track_) {
    report.time_to_first_track_ms =
        static_cast<double>(std::max<std::int64_t>(*first_track_ - motion_, 0)) / 1000;
  }
  if (samples_.empty()) return report;

  std::vector<double> sorted;
  std::vector<double> normalised;
  double sum = 0;
  for (const Sample& sample : samples_) {
    sorted.push_back(sample.error_px);
    sum += sample.error_px;
    if (sample.nees) normalised.push_back(*sample.nees);
    report.score_curve.add(sample.score, sample.error_px);
  }
  std::sort(sorted.begin(), sorted.end());
  const auto count = static_cast<double>(sorted.size());
  report.mean_px = sum / count;
  report.median_px = quantile(sorted, 0.5);
  report.p5_px = quantile(sorted, 0.05);
  report.p25_px = quantile(sorted, 0.25);
  report.p75_px = quantile(sorted, 0.75);
  report.p95_px = quantile(sorted, 0.95);
  report.max_px = sorted.back();
  report.within_2px_percent = percent_within(sorted, 2);
  report.within_3p5px_percent = percent_within(sorted, 3.5);
  report.within_4px_percent = percent_within(sorted, 4);
  report.lost_percent = 100 * static_cast<double>(lost_ticks_) / count;
  report.longest_loss_ms = static_cast<double>(longest_loss_us_) / 1000;
  report.covariance = covariance_report(std::move(normalised));
  return report;
}

}  // namespace puck
