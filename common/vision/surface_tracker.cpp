#include "common/vision/surface_tracker.h"

#include <utility>

#include "common/vision/interfaces/event_pieces.h"

namespace puck {

SurfaceTracker::SurfaceTracker(SensorSize sensor, const PipelineParams& params,
                               const PuckSizeModel& size_model)
    : SurfaceTracker(sensor, params, size_model, make_pipeline(sensor, params, size_model)) {}

SurfaceTracker::SurfaceTracker(SensorSize sensor, const PipelineParams& params,
                               const PuckSizeModel& size_model,
                               std::unique_ptr<TrackingPipeline> pipeline)
    : surface_(sensor, search_params(params).surface_params()),
      pipeline_(std::move(pipeline)),
      search_(sensor, search_params(params), size_model),
      roi_only_(is_roi_only(params) && !pipeline_->needs_events()),
      search_delay_us_(search_params(params).search_delay_us) {
  if (searches_fresh(params)) fresh_.emplace(sensor);
}

void SurfaceTracker::update(const EventPacket& packet) {
  for_each_piece(packet.start, packet.events, pipeline_->decision_period_us(),
                 [&](std::span<const Event> piece) { take(packet.start, piece); });
}

PuckEstimate SurfaceTracker::estimate() {
  const PuckEstimate estimate = step();
  // A search's result counts at once.
  return search_if_wanted() ? step() : estimate;
}

PuckEstimate SurfaceTracker::step() {
  surface_.snapshot(pipeline_->region_needed(), snapshot_);
  const PuckEstimate estimate = pipeline_->step(snapshot_);
  if (roi_only_) {
    const Region next = pipeline_->region_needed();
    surface_.keep_only(next.empty() ? Region::all_of(surface_.size()) : next);
  }
  return estimate;
}

void SurfaceTracker::take(Timestamp start, std::span<const Event> piece) {
  surface_.update(start, piece);
  if (fresh_) fresh_->take(start, piece);
  if (!pipeline_->needs_events()) return;
  pipeline_->take(start, piece);
  search_if_wanted();
}

// Returns whether the pipeline has got a search's result.
bool SurfaceTracker::search_if_wanted() {
  if (unanswered_) {
    if (surface_.newest_event() - unanswered_->time < search_delay_us_) return false;
    pipeline_->take(*unanswered_);
    unanswered_.reset();
    return true;
  }
  const SearchRequest wanted = pipeline_->search_wanted();
  if (wanted.region.empty()) return false;
  surface_.snapshot(search_.snapshot_region(wanted.region), searched_);
  if (wanted.fresh_only && fresh_) {
    fresh_->copy_rows(searched_.region, searched_fresh_);
    searched_fresh_.darken_stale(searched_.region, searched_.grey.mutable_view());
  }
  SearchResult found = search_.search(searched_, wanted);
  if (search_delay_us_ > 0) {
    unanswered_ = std::move(found);
    return false;
  }
  pipeline_->take(found);
  return true;
}

}  // namespace puck
