#include "tools/play/estimate_errors.h"

#include <cmath>

namespace puck {
namespace {

constexpr std::uint64_t kErrorStream = 40;
// Larger changes of velocity within one step come from hits and bounces only.
constexpr double kTurn_m_s = 0.3;
constexpr std::int64_t kStrayUs = 1'000;

}  // namespace

bool is_turn(const SimulatedTruth& before, const SimulatedTruth& after) {
  return before.in_play && after.in_play &&
         std::hypot(after.velocity.x_m_s - before.velocity.x_m_s,
                    after.velocity.y_m_s - before.velocity.y_m_s) > kTurn_m_s;
}

EstimateErrors::EstimateErrors(const EstimateErrorParams& params, SensorSize sensor,
                               std::int64_t seed)
    : params_(params), sensor_(sensor), random_(seed, kErrorStream) {
  error_x_px_ = params_.sigma_x_px * random_.normal();
  error_y_px_ = params_.sigma_y_px * random_.normal();
}

// An Ornstein-Uhlenbeck process: its variance is the same at all times and for any step.
void EstimateErrors::drift(std::int64_t passed_us) {
  const double keep = std::exp(-static_cast<double>(passed_us) / params_.correlation_us);
  const double fresh = std::sqrt(1 - keep * keep);
  error_x_px_ = keep * error_x_px_ + fresh * params_.sigma_x_px * random_.normal();
  error_y_px_ = keep * error_y_px_ + fresh * params_.sigma_y_px * random_.normal();
}

// `newest_` and `velocity_` are still from before the turn.
void EstimateErrors::turn(Timestamp now) {
  if (now >= noticed_from_) {
    turned_ = newest_->time;
    turned_at_ = newest_->position_px;
    turned_from_ = velocity_;
  }
  noticed_from_ = now + static_cast<std::int64_t>(params_.notice_us);
  if (random_.uniform() >= params_.loss_share) return;
  const double loss_us = -params_.loss_us * std::log(1 - random_.uniform());
  seen_from_ = now + static_cast<std::int64_t>(loss_us);
}

void EstimateErrors::stray(std::int64_t passed_us) {
  if (params_.strays_per_s == 0) return;
  if (random_.uniform() >= params_.strays_per_s * 1e-6 * static_cast<double>(passed_us)) return;
  stray_at_ = {random_.uniform(0, sensor_.width - 1), random_.uniform(0, sensor_.height - 1)};
  stray_until_ = newest_->time + kStrayUs;
}

void EstimateErrors::watch(const SimulatedTruth& truth) {
  const bool was_in_play = newest_ && newest_->in_play;
  if (truth.in_play && !was_in_play) {
    seen_from_ = truth.time + static_cast<std::int64_t>(params_.detection_us);
  }
  if (newest_ && is_turn(*newest_, truth)) turn(truth.time);
  velocity_ = {};
  if (newest_) {
    const std::int64_t passed_us = truth.time - newest_->time;
    drift(passed_us);
    stray(passed_us);
    if (was_in_play && truth.in_play && passed_us > 0) {
      const double per_s = 1e6 / static_cast<double>(passed_us);
      velocity_ = {(truth.position_px.x - newest_->position_px.x) * per_s,
                   (truth.position_px.y - newest_->position_px.y) * per_s};
    }
  }
  newest_ = truth;
  was_seen_ = was_seen_ || (truth.in_play && truth.time >= seen_from_);
}

PuckEstimate EstimateErrors::estimate() const {
  PuckEstimate estimate;
  if (!newest_) return estimate;
  estimate.newest_event = newest_->time;
  Pixel at = newest_->position_px;
  PixelVelocity velocity = velocity_;
  if (newest_->time < noticed_from_) {
    const double since_s = 1e-6 * static_cast<double>(newest_->time - turned_);
    velocity = turned_from_;
    at = {turned_at_.x + since_s * velocity.x, turned_at_.y + since_s * velocity.y};
  }
  const bool in_image =
      at.x >= 0 && at.y >= 0 && at.x <= sensor_.width - 1 && at.y <= sensor_.height - 1;
  if (!newest_->in_play || !in_image || newest_->time < seen_from_) {
    estimate.state = was_seen_ ? TrackState::kLost : TrackState::kSearching;
    return estimate;
  }
  const double lag_s = params_.lag_us * 1e-6;
  estimate.state = TrackState::kTracking;
  estimate.resting = velocity.x == 0 && velocity.y == 0;
  estimate.position = Pixel{at.x + params_.bias_x_px + error_x_px_ - lag_s * velocity.x,
                            at.y + params_.bias_y_px + error_y_px_ - lag_s * velocity.y};
  if (newest_->time < stray_until_) estimate.position = stray_at_;
  estimate.velocity = velocity;
  estimate.size = newest_->size_px;
  estimate.score = 1;
  estimate.covariance[0] = estimate.covariance[5] =
      params_.reported_sigma_px * params_.reported_sigma_px;
  return estimate;
}

}  // namespace puck
