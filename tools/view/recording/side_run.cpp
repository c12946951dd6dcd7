#include "tools/view/recording/side_run.h"

#include <algorithm>
#include <chrono>

#include "common/vision/geometry/image_bounds.h"

namespace puck {
namespace {

// Sensor time between two points of the trail.
constexpr std::int64_t kTrailStep_us = 2'000;
// As AccuracyScore's.
constexpr double kLost_px = 20;

template <typename Call>
std::int64_t us_of(const Call& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() -
                                                               begin)
      .count();
}

}  // namespace

SideRun::SideRun(const OpenedRecording& recording, const std::string& name)
    : recording_(recording), surface_(default_params().surface_params()) {
  const std::optional<TrackerSetup> setup = recording.setup_of(name);
  if (name != kNoTracker) track_.name = name;
  if (!setup) return;
  tracker_ = setup->make(recording.sensor());
  if (setup->algorithm == Algorithm::kPuck)
    surface_ = search_params(setup->pipeline_params()).surface_params();
  if (recording.table() != nullptr) table_.emplace(*recording.table(), recording.sensor());
}

void SideRun::update(const EventPacket& events) {
  if (tracker_) update_us_ += us_of([&] { tracker_->update(events); });
}

void SideRun::tick(Timestamp tick, const std::optional<PuckEstimate>& logged) {
  if (track_.name.empty()) return;
  if (tracker_) {
    work_.record(update_us_ + us_of([&] { track_.estimate = tracker_->estimate(); }));
    update_us_ = 0;
  } else {
    track_.estimate = logged;
  }
  if (!track_.estimate) return;
  if (table_) table_->take(*track_.estimate, tick);
  auto& trail = track_.trail;
  if (trail.empty() || tick - trail.back().time >= kTrailStep_us) {
    const auto is_young = [&](const ViewTrack::TrailPoint& point) {
      return tick - point.time <= ViewTrack::kTrail_us;
    };
    // The points are in the order of their times: most often only the first is too old.
    trail.erase(trail.begin(), std::find_if(trail.begin(), trail.end(), is_young));
    trail.push_back({tick, track_.estimate->position});
  }
  const TruthTrack* truth = recording_.truth();
  judge(truth != nullptr ? truth->at(tick, recording_.truth_gap_us()) : std::nullopt);
}

void SideRun::judge(const std::optional<TruthRow>& truth) {
  const PuckEstimate& estimate = *track_.estimate;
  const bool tracks = estimate.state == TrackState::kTracking;
  was_tracked_ = was_tracked_ || tracks;
  error_px_.reset();
  is_lost_.reset();
  const bool is_there =
      truth && is_visible(*truth) && is_in_image(truth->centre, recording_.sensor());
  if (is_there && estimate.position) error_px_ = distance_px(*estimate.position, truth->centre);
  if (is_there) {
    is_lost_ = !tracks || !error_px_ || *error_px_ > kLost_px;
  } else if (recording_.truth() == nullptr && was_tracked_) {
    is_lost_ = !tracks && !estimate.left_image;
  }
}

}  // namespace puck
