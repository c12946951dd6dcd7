#include "common/evaluation/accuracy_score.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace puck {
namespace {

constexpr double kNoPositionPx = 100;
constexpr double kLostPx = 20;
constexpr std::int64_t kUsualSettleUs = 200'000;
constexpr std::int64_t kShortTruthUs = 1'000'000;
constexpr std::int64_t kLongestCoastUs = 50'000;

double error_of(const PuckEstimate& estimate, Pixel truth) {
  if (!estimate.position) return kNoPositionPx;
  return distance_px(*estimate.position, truth);
}

bool in_image(Pixel centre, SensorSize sensor) {
  return centre.x >= 0 && centre.x <= sensor.width - 1 && centre.y >= 0 &&
         centre.y <= sensor.height - 1;
}

}  // namespace

AccuracyScore::AccuracyScore(TruthTrack truth, SensorSize sensor, const AccuracyParams& params)
    : truth_(std::move(truth)),
      sensor_(sensor),
      truth_gap_us_(params.truth_gap_us),
      motion_(truth_.first_motion().value_or(truth_.first())),
      settle_us_(
          params.settle_us.value_or(truth_.last() - motion_ < kShortTruthUs ? 0 : kUsualSettleUs)) {
}

void AccuracyScore::add(Timestamp tick, const PuckEstimate& estimate) {
  const std::optional<TruthRow> truth = truth_.at(tick, truth_gap_us_);
  if (truth) {
    judge_what_is_said(tick, *truth, estimate);
  } else if (tick >= truth_.first() && tick <= truth_.last()) {
    ++gap_ticks_;
  }
  if (!truth || !in_image(truth->centre, sensor_) || !is_visible(*truth)) {
    lost_since_.reset();
    return;
  }
  const double error_px = error_of(estimate, truth->centre);
  const bool lost = error_px > kLostPx || estimate.state != TrackState::kTracking;
  if (!lost && !first_track_) first_track_ = tick;
  if (tick - motion_ < settle_us_) return;

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

void AccuracyScore::judge_what_is_said(Timestamp tick, const TruthRow& truth,
                                       const PuckEstimate& estimate) {
  ++known_ticks_;
  if (is_visible(truth)) {
    hidden_since_.reset();
  } else if (!hidden_since_) {
    hidden_since_ = tick;
  }
  if (estimate.state != TrackState::kTracking) return;
  const bool coasts_too_long = hidden_since_ && tick - *hidden_since_ > kLongestCoastUs;
  if (coasts_too_long || error_of(estimate, truth.centre) > kLostPx) ++wrong_ticks_;
}

AccuracyReport AccuracyScore::report() const {
  AccuracyReport report{error_statistics(samples_)};
  report.settle_ms = static_cast<double>(settle_us_) / 1000;
  if (first_track_) {
    report.time_to_first_track_ms =
        static_cast<double>(std::max<std::int64_t>(*first_track_ - motion_, 0)) / 1000;
  }
  const auto percent = [](std::int64_t part, std::int64_t whole) {
    return 100 * static_cast<double>(part) / static_cast<double>(whole);
  };
  if (known_ticks_ > 0) report.said_and_wrong_percent = percent(wrong_ticks_, known_ticks_);
  if (gap_ticks_ > 0) report.truth_gap_percent = percent(gap_ticks_, gap_ticks_ + known_ticks_);
  if (samples_.empty()) return report;
  report.lost_percent = percent(lost_ticks_, report.estimates);
  report.longest_loss_ms = static_cast<double>(longest_loss_us_) / 1000;
  std::vector<double> normalised;
  for (const ScoredEstimate& sample : samples_) {
    if (sample.nees) normalised.push_back(*sample.nees);
  }
  report.covariance = covariance_report(std::move(normalised));
  return report;
}

}  // namespace puck
