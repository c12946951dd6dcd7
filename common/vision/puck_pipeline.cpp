#include "common/vision/puck_pipeline.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

// A puck slower than this for so long is at rest.
constexpr double kRestingPxPerS = 20;
constexpr std::int64_t kRestingAfterUs = 100'000;

double speed_of(PixelVelocity velocity) { return std::hypot(velocity.x, velocity.y); }

}  // namespace

PuckPipeline::PuckPipeline(SensorSize sensor, const PipelineParams& params,
                           const PuckSizeModel& size_model)
    : sensor_(sensor),
      params_(params),
      size_model_(size_model),
      kernels_(params.kernels),
      detector_(sensor, params.detector, size_model),
      tracker_(sensor, params.tracker, size_model),
      motion_(params.motion),
      region_(detector_.region()) {
  if (params.loss.coast_us < 0 || params.loss.search_period_us < 0) {
    throw std::invalid_argument(
        "tracker.coast_us and tracker.search_period_us must not be negative");
  }
}

Region PuckPipeline::region_needed() const {
  if (region_.empty()) return {};
  // A kernel on the region's border reaches beyond it, and the blur a little more.
  const int reach = std::max(detector_.reach(), kernel_reach(region_)) + GaussianBlur::kRadius;
  return region_.inflated(reach).intersect(Region::all_of(sensor_));
}

// The size model is linear, so the largest kernel in a region is that of one of its corners.
int PuckPipeline::kernel_reach(const Region& region) const {
  int reach = 0;
  for (const int x : {region.x, region.right() - 1}) {
    for (const int y : {region.y, region.bottom() - 1}) {
      const EllipseKernel& kernel =
          kernels_.nearest(size_model_.at({static_cast<double>(x), static_cast<double>(y)}));
      reach = std::max({reach, kernel.width() / 2 + 1, kernel.height() / 2 + 1});
    }
  }
  return reach;
}

PuckEstimate PuckPipeline::step(const SurfaceSnapshot& snapshot) {
  const Timestamp now = snapshot.newest_event;
  const Region looked_at = region_;
  const bool something_new = snapshot.events_applied != events_seen_;
  events_seen_ = snapshot.events_applied;
  if (region_.empty()) {
    if (now >= next_search_) plan_search(now);
  } else if (something_new && !snapshot.region.empty()) {
    blur_.apply(snapshot.grey.view(), blurred_);
    picture_.set_picture(blurred_.view(), snapshot.region);
    if (state_ == TrackState::kTracking) {
      track(now);
    } else {
      search(now);
    }
  }
  return estimate(snapshot, looked_at);
}

void PuckPipeline::track(Timestamp now) {
  const Pixel expected = params_.predicts ? motion_.expected_at(now) : position_;
  const PuckTracker::Step found = tracker_.step(picture_, region_, expected, kernels_);
  score_ = found.score;
  motion_.measure(found.position, now);
  position_ = params_.predicts ? motion_.position() : found.position;
  if (params_.loss.enabled && found.score < params_.loss.lowest_score) {
    coast(now);
    return;
  }
  coasting_ = false;
  last_good_ = now;
  if (speed_of(motion_.velocity()) > kRestingPxPerS) resting_since_ = now;
  region_ = tracker_.region_around(position_, kernels_);
  if (region_.empty()) lose(now);
}

// Weak evidence is better than none and is followed, but something better is looked for around it.
void PuckPipeline::coast(Timestamp now) {
  coasting_ = true;
  if (now >= next_search_) {
    next_search_ = now + params_.loss.search_period_us;
    if (const auto found = detector_.detect(picture_, region_, kernels_)) {
      begin_track(found->position, now);
      return;
    }
  }
  if (now - last_good_ > params_.loss.coast_us) {
    lose(now);
  } else {
    region_ = search_region(now);
  }
}

void PuckPipeline::search(Timestamp now) {
  const auto found = detector_.detect(picture_, region_, kernels_);
  if (found) {
    begin_track(found->position, now);
  } else if (params_.loss.enabled) {
    next_search_ = now + params_.loss.search_period_us;
    region_ = {};
  }
}

void PuckPipeline::begin_track(Pixel position, Timestamp now) {
  state_ = TrackState::kTracking;
  position_ = position;
  motion_.start(position, now);
  score_ = picture_.contrast_at(kernels_.nearest(size_model_.at(position)),
                                static_cast<int>(std::lround(position.x)),
                                static_cast<int>(std::lround(position.y)));
  coasting_ = false;
  left_image_.reset();
  last_good_ = now;
  resting_since_ = now;
  region_ = tracker_.first_region_at(position, kernels_);
}

void PuckPipeline::lose(Timestamp now) {
  state_ = TrackState::kLost;
  coasting_ = false;
  const Region image = Region::all_of(sensor_);
  const Pixel inside{std::clamp(position_.x, 0.0, image.width - 1.0),
                     std::clamp(position_.y, 0.0, image.height - 1.0)};
  if (!(inside == position_)) left_image_ = inside;
  position_ = inside;
  plan_search(now);
}

void PuckPipeline::plan_search(Timestamp now) {
  region_ = state_ == TrackState::kSearching ? detector_.region() : search_region(now);
}

Region PuckPipeline::search_region(Timestamp now) const {
  const double unseen_s = static_cast<double>(now - last_good_) * 1e-6;
  const double radius = params_.loss.search_radius_px + params_.loss.search_growth_px_s * unseen_s;
  const int side = static_cast<int>(std::min(2 * radius, 4.0 * SensorSize::kMax)) | 1;
  return Region::around(position_, side, side).intersect(Region::all_of(sensor_));
}

PuckEstimate PuckPipeline::estimate(const SurfaceSnapshot& snapshot,
                                    const Region& looked_at) const {
  PuckEstimate estimate;
  estimate.state = state_;
  estimate.newest_event = snapshot.newest_event;
  estimate.events_applied = snapshot.events_applied;
  estimate.region = looked_at;
  estimate.left_image = left_image_;
  if (state_ != TrackState::kTracking) return estimate;

  estimate.position = position_;
  estimate.velocity = motion_.velocity();
  estimate.covariance = motion_.covariance();
  estimate.size = size_model_.at(position_);
  estimate.score = score_;
  estimate.coasting = coasting_;
  estimate.resting = snapshot.newest_event - resting_since_ > kRestingAfterUs;
  return estimate;
}

}  // namespace puck
