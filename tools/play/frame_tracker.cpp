#include "tools/play/frame_tracker.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "tools/play/option_ranges.h"

namespace puck {
namespace {

constexpr std::uint64_t kFrameStream = 42;

}  // namespace

FrameTracker::FrameTracker(const FrameTrackerParams& params, SensorSize sensor, std::int64_t seed)
    : params_(params),
      sensor_(sensor),
      random_(seed, kFrameStream),
      period_us_(1e6 / params.rate_hz) {
  kFramesRange.require(params.rate_hz);
  if (!(params.exposure_share > 0 && params.exposure_share <= 1)) {
    throw std::invalid_argument("a camera's exposure must be above 0 and at most 1 period, got " +
                                std::to_string(params.exposure_share));
  }
}

std::int64_t FrameTracker::delay_us() const {
  return static_cast<std::int64_t>(period_us_) + params_.processing_us;
}

std::optional<PuckEstimate> FrameTracker::watch(const SimulatedTruth& truth) {
  const double begin_us = static_cast<double>(frame_) * period_us_;
  const double end_us = begin_us + params_.exposure_share * period_us_;
  const auto now_us = static_cast<double>(truth.time.us);
  if (now_us < begin_us) return std::nullopt;
  if (now_us <= end_us) {
    const Pixel at = truth.position_px;
    ++samples_;
    if (truth.in_play && at.x >= 0 && at.y >= 0 && at.x <= sensor_.width - 1 &&
        at.y <= sensor_.height - 1) {
      if (seen_++ == 0) first_ = at;
      last_ = at;
      size_ = truth.size_px;
      sum_x_px_ += at.x;
      sum_y_px_ += at.y;
    }
    return std::nullopt;
  }
  const PuckEstimate estimate = look(static_cast<std::int64_t>((begin_us + end_us) / 2));
  ++frame_;
  samples_ = seen_ = 0;
  sum_x_px_ = sum_y_px_ = 0;
  return estimate;
}

PuckEstimate FrameTracker::look(std::int64_t middle_us) {
  PuckEstimate estimate;
  estimate.newest_event = {middle_us};
  estimate.state = TrackState::kLost;
  // A puck that was visible for only a part of the exposure is not detected.
  if (seen_ == 0 || seen_ < samples_) return estimate;
  const double smear_px = std::hypot(last_.x - first_.x, last_.y - first_.y);
  const double sigma_px = std::hypot(params_.sigma_px, params_.smear_share * smear_px);
  const double exposure_s = params_.exposure_share * period_us_ * 1e-6;
  estimate.state = TrackState::kTracking;
  estimate.position = Pixel{sum_x_px_ / seen_ + sigma_px * random_.normal(),
                            sum_y_px_ / seen_ + sigma_px * random_.normal()};
  estimate.velocity = {(last_.x - first_.x) / exposure_s, (last_.y - first_.y) / exposure_s};
  estimate.size = size_;
  estimate.score = 1;
  estimate.covariance[0] = estimate.covariance[5] = sigma_px * sigma_px;
  return estimate;
}

}  // namespace puck
