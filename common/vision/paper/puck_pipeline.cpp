#include "common/vision/paper/puck_pipeline.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/vision/correlation/gaussian_blur.h"
#include "common/vision/geometry/image_bounds.h"

namespace puck {
namespace {

// A puck slower than this for kRestingAfterUs is at rest.
constexpr double kRestingPxPerS = 20;
constexpr std::int64_t kRestingAfterUs = 100'000;

// The surface shows the puck late by more than the sensor's lag. A contour pixel stays bright until
// its neighbours have fired in turn, which takes some way rather than some time, px …
constexpr double kEdgePx = 0.27;
// … for a puck faster than this; nearly none for a slower one.
constexpr double kSlowPxPerS = 200;
// What the last events of an edge that passes lag behind its first ones, µs.
constexpr double kEdgeUs = 130;
// Standard deviation of what remains. Steps share it, so that it does not average out.
constexpr double kShownSigmaPx = 0.4;

double speed_of(PixelVelocity velocity) { return std::hypot(velocity.x, velocity.y); }

double shown_late_s(double speed_px_s, double lag_us) {
  return (lag_us + kEdgeUs) * 1e-6 + kEdgePx / std::hypot(speed_px_s, kSlowPxPerS);
}

}  // namespace

PuckPipeline::PuckPipeline(SensorSize sensor, const PuckPipelineParams& params,
                           const PuckSizeModel& size_model)
    : sensor_(sensor),
      params_(params),
      size_model_(size_model),
      kernels_(params.kernels),
      tracker_(sensor, params.tracker, size_model, params.make_ring(sensor, size_model)),
      motion_(params.motion),
      detection_region_(detection_region(sensor, params.detector)) {
  if (params.loss.coast_us < 0 || params.loss.search_period_us < 0) {
    throw std::invalid_argument(
        "tracker.coast_us and tracker.search_period_us must not be negative");
  }
  make_room();
}

// Runs one step with the largest puck on an empty surface, so that no later step allocates.
void PuckPipeline::make_room() {
  const double right = sensor_.width - 1;
  const double bottom = sensor_.height - 1;
  for (const Pixel corner :
       {Pixel{0, 0}, Pixel{right, 0}, Pixel{0, bottom}, Pixel{right, bottom}}) {
    const Region region = tracker_.whole_region_around(corner, kernels_);
    SurfaceSnapshot nothing;
    nothing.region = with_surroundings(region);
    nothing.grey.resize(nothing.region.width, nothing.region.height);
    tracker_.step(nothing, region, corner, kernels_);
  }
}

Region PuckPipeline::region_needed() const {
  if (region_.empty()) return {};
  return with_surroundings(region_).intersect(Region::all_of(sensor_));
}

// Adds the reach of kernels on the region's border, and that of the blur.
Region PuckPipeline::with_surroundings(const Region& region) const {
  return region.inflated(kernels_.reach_beyond(region, size_model_) + GaussianBlur::kRadius);
}

PuckEstimate PuckPipeline::step(const SurfaceSnapshot& snapshot) {
  now_ = snapshot.newest_event;
  const bool something_new = snapshot.events_applied != events_seen_;
  events_seen_ = snapshot.events_applied;
  search_ = {};
  if (something_new) {
    looked_at_ = region_;
    if (state_ == TrackState::kTracking && !snapshot.region.empty()) {
      track(snapshot);
    }
    if (state_ != TrackState::kTracking) plan_search(now_);
    if (looked_at_.empty()) looked_at_ = search_;
  }
  return estimate(snapshot);
}

SearchRequest PuckPipeline::search_wanted() {
  if (search_.empty()) return {};
  if (params_.loss.enabled) next_search_ = now_ + params_.loss.search_period_us;
  return {.region = std::exchange(search_, {})};
}

void PuckPipeline::take(const SearchResult& result) {
  // A recovered track is newer than the search's result.
  if (result.candidates.empty() || (state_ == TrackState::kTracking && !coasting_)) return;
  const double score = result.candidates.front().score;
  if (params_.loss.enabled && score < params_.loss.lowest_start_score) return;
  begin_track(result.candidates.front(), result.time);
  looked_at_ = result.request.region;
}

void PuckPipeline::track(const SurfaceSnapshot& snapshot) {
  const Timestamp now = snapshot.newest_event;
  const Pixel expected = params_.predicts ? motion_.expected_at(now) : position_;
  const PuckTracker::Step found = tracker_.step(snapshot, region_, expected, kernels_);
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

// Follows weak evidence, and searches around it for something better.
void PuckPipeline::coast(Timestamp now) {
  coasting_ = true;
  if (now - last_good_ > params_.loss.coast_us) {
    lose(now);
    return;
  }
  plan_search(now);
  region_ = tracker_.region_around(position_, kernels_);
  if (region_.empty()) lose(now);
}

void PuckPipeline::begin_track(const SearchCandidate& candidate, Timestamp time) {
  state_ = TrackState::kTracking;
  position_ = candidate.position;
  motion_.start(position_, time);
  score_ = candidate.score;
  coasting_ = false;
  left_image_.reset();
  last_good_ = time;
  resting_since_ = time;
  region_ = tracker_.first_region_at(position_, kernels_);
  search_ = {};
}

void PuckPipeline::lose(Timestamp now) {
  state_ = TrackState::kLost;
  coasting_ = false;
  region_ = {};
  const Pixel inside = nearest_in_image(position_, sensor_);
  if (!(inside == position_)) left_image_ = inside;
  position_ = inside;
  next_search_ = now;
}

void PuckPipeline::plan_search(Timestamp now) {
  if (now < next_search_) return;
  search_ = state_ == TrackState::kSearching ? detection_region_ : search_region(now);
}

Region PuckPipeline::search_region(Timestamp now) const {
  const double unseen_s = static_cast<double>(now - last_good_) * 1e-6;
  const double radius = params_.loss.search_radius_px + params_.loss.search_growth_px_s * unseen_s;
  const int side = static_cast<int>(std::min(2 * radius, 4.0 * SensorSize::kMax)) | 1;
  return Region::around(position_, side, side).intersect(Region::all_of(sensor_));
}

PuckEstimate PuckPipeline::estimate(const SurfaceSnapshot& snapshot) const {
  PuckEstimate estimate;
  estimate.state = state_;
  estimate.newest_event = snapshot.newest_event;
  estimate.events_applied = snapshot.events_applied;
  estimate.region = looked_at_;
  estimate.left_image = left_image_;
  if (state_ != TrackState::kTracking) return estimate;

  const PixelVelocity velocity = motion_.velocity();
  estimate.position = position_;
  estimate.velocity = velocity;
  estimate.covariance = motion_.covariance();
  if (params_.leads) {
    const double late_s = shown_late_s(speed_of(velocity), params_.contour.lag_us);
    estimate.position = {position_.x + late_s * velocity.x, position_.y + late_s * velocity.y};
    for (const std::size_t axis : {0, 1}) {
      // Of position + late_s · velocity, and what is not known of the lag.
      const double pv = estimate.covariance[4 * axis + axis + 2];
      const double vv = estimate.covariance[4 * (axis + 2) + axis + 2];
      estimate.covariance[5 * axis] +=
          late_s * (2 * pv + late_s * vv) + kShownSigmaPx * kShownSigmaPx;
      estimate.covariance[4 * axis + axis + 2] += late_s * vv;
      estimate.covariance[4 * (axis + 2) + axis] += late_s * vv;
    }
  }
  estimate.size = size_model_.at(position_);
  estimate.score = score_;
  estimate.coasting = coasting_;
  estimate.resting = snapshot.newest_event - resting_since_ > kRestingAfterUs;
  return estimate;
}

}  // namespace puck
