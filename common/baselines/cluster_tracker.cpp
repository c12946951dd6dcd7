#include "common/baselines/cluster_tracker.h"

#include <algorithm>
#include <cmath>

#include "common/baselines/param_check.h"

namespace puck {
namespace {

double variance_of_contour(double axis_px) { return axis_px * axis_px / 8; }
double axis_of_contour(double variance_px2) { return std::sqrt(8 * variance_px2); }

}  // namespace

ClusterTrackerParams puck_cluster_params() {
  ClusterTrackerParams params;
  params.max_distance_widths = 0.75;
  return params;
}

ClusterTracker::ClusterTracker(SensorSize sensor, const ClusterTrackerParams& params,
                               const PuckSizeModel& size_model, const PipelineParams& detection)
    : params_(params),
      size_model_(search_params(detection).sizes_of(size_model)),
      detector_(std::in_place, sensor, detection, size_model) {
  require_share("cluster.position_share", params.position_share);
  require_share("cluster.shape_share", params.shape_share);
  require_share("cluster.velocity_share", params.velocity_share);
  require_above_zero("cluster.max_distance_px", params.max_distance_px);
  require_at_least("cluster.max_distance_widths", params.max_distance_widths, 0.0);
  require_above_zero("cluster.active_from", params.active_from);
  require_above_zero("cluster.activity_decay_us", params.activity_decay_us);
  require_at_least("cluster.regulation_events", params.regulation_events, 1);
}

void ClusterTracker::update(const EventPacket& packet) {
  if (packet.empty()) return;
  events_applied_ += static_cast<std::int64_t>(packet.events.size());
  newest_event_ = packet.newest();
  if (detector_) {
    detector_->update(packet);
    return;
  }
  for (const Event& event : packet.events) {
    apply({static_cast<double>(event.x), static_cast<double>(event.y)}, packet.time_of(event));
  }
}

PuckEstimate ClusterTracker::estimate() {
  if (detector_) {
    const PuckEstimate detected = detector_->estimate();
    if (detected.state != TrackState::kTracking) return detected;
    start({*detected.position, size_model_.at(*detected.position)}, detected.newest_event);
    detector_.reset();
  }
  PuckEstimate estimate;
  estimate.state = TrackState::kTracking;
  estimate.position = position_;
  estimate.velocity = velocity_;
  estimate.size = {axis_of_contour(shape_.xx), axis_of_contour(shape_.yy)};
  const auto since_regulation_us = static_cast<double>(newest_event_ - last_regulation_);
  const double activity = activity_ * std::exp(-since_regulation_us / params_.activity_decay_us);
  estimate.score = std::min(1.0, activity / params_.active_from);
  estimate.newest_event = newest_event_;
  estimate.events_applied = events_applied_;
  return estimate;
}

void ClusterTracker::start(const PuckSeed& seed, Timestamp now) {
  position_ = seed.position;
  velocity_ = {};
  shape_ = {variance_of_contour(seed.size.width), 0, variance_of_contour(seed.size.height)};
  activity_ = params_.active_from;
  last_own_event_ = now;
  last_regulation_ = now;
  events_to_regulation_ = params_.regulation_events;
}

void ClusterTracker::apply(Pixel event, Timestamp time) {
  const double dx = event.x - position_.x;
  const double dy = event.y - position_.y;
  if (std::hypot(dx, dy) < max_distance_px()) {
    activity_ += 1;

    const double keep = 1 - params_.shape_share;
    if (params_.round_shape) {
      const double spread = (dx * dx + dy * dy) / 2;
      shape_.xx = keep * shape_.xx + params_.shape_share * spread;
      shape_.yy = keep * shape_.yy + params_.shape_share * spread;
      shape_.xy = 0;
    } else {
      shape_.xx = keep * shape_.xx + params_.shape_share * dx * dx;
      shape_.xy = keep * shape_.xy + params_.shape_share * dx * dy;
      shape_.yy = keep * shape_.yy + params_.shape_share * dy * dy;
    }

    const double step_x = params_.position_share * dx;
    const double step_y = params_.position_share * dy;
    position_.x += step_x;
    position_.y += step_y;

    const std::int64_t dt_us = time - last_own_event_;
    if (dt_us > 0) {
      const double dt_s = static_cast<double>(dt_us) * 1e-6;
      const double share = params_.velocity_share;
      velocity_.x = (1 - share) * velocity_.x + share * step_x / dt_s;
      velocity_.y = (1 - share) * velocity_.y + share * step_y / dt_s;
    }
    last_own_event_ = time;
  }
  if (--events_to_regulation_ <= 0) regulate(time);
}

double ClusterTracker::max_distance_px() const {
  if (params_.max_distance_widths <= 0) return params_.max_distance_px;
  return params_.max_distance_widths * size_model_.at(position_).width;
}

void ClusterTracker::regulate(Timestamp now) {
  const auto since_last_us = static_cast<double>(now - last_regulation_);
  activity_ *= std::exp(-since_last_us / params_.activity_decay_us);
  last_regulation_ = now;
  events_to_regulation_ = params_.regulation_events;
}

}  // namespace puck
