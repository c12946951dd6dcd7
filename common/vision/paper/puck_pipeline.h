#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/events/sensor_size.h"
#include "common/vision/correlation/kernel_bank.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/interfaces/puck_estimate.h"
#include "common/vision/interfaces/tracking_pipeline.h"
#include "common/vision/paper/pixel_motion.h"
#include "common/vision/paper/puck_tracker.h"
#include "common/vision/paper/search_params.h"

namespace puck {

/// Conditions for a lost track, and plan of the search after it.
struct LossParams {
  /// Off: a detected puck is tracked for ever, as in the paper.
  bool enabled = true;
  /// Lower scores are weak evidence.
  double lowest_score = 0.36;
  /// Lowest score of a search candidate that starts a track.
  double lowest_start_score = 0;
  /// Longest sensor time on weak evidence, with a search around it, before the puck counts as lost.
  std::int64_t coast_us = 50'000;
  /// Sensor time between searches.
  std::int64_t search_period_us = 5'000;
  /// First radius of the search around the last expected position …
  double search_radius_px = 40;
  /// … and its growth, until the search covers the whole image.
  double search_growth_px_s = 3'000;
};

/// Settings of the paper's method and of what refines it.
struct PuckPipelineParams : SearchParams {
  /// While there is a track, only the next step's region of the surface is kept up to date: an
  /// optimisation that the paper names but did not test. Elsewhere no puck can be found then.
  bool roi_only = false;
  TrackerParams tracker;
  PixelMotionParams motion;
  LossParams loss;
  /// The Gaussian and the window are centred on the predicted position instead of the last one, and
  /// the filtered position is published.
  bool predicts = false;
  /// The published position is where the puck is by now, not where the surface shows it.
  bool leads = false;
};

/// The paper's second thread: detection, then tracking, one step for each snapshot of the surface.
/// It needs no single events. The detection is a search like those for a lost puck.
class PuckPipeline final : public TrackingPipeline {
 public:
  /// Throws std::invalid_argument, naming the key, when a parameter is out of range.
  PuckPipeline(SensorSize sensor, const PuckPipelineParams& params,
               const PuckSizeModel& size_model);

  bool needs_events() const override { return false; }
  std::int64_t decision_period_us() const override { return 0; }
  void take(Timestamp, std::span<const Event>) override {}

  /// Empty while the puck is searched for.
  Region region_needed() const override;
  PuckEstimate step(const SurfaceSnapshot& snapshot) override;

  SearchRequest search_wanted() override;
  void take(const SearchResult& result) override;

 private:
  void make_room();
  Region with_surroundings(const Region& region) const;
  void track(const SurfaceSnapshot& snapshot);
  void coast(Timestamp now);
  void begin_track(const SearchCandidate& candidate, Timestamp time);
  void lose(Timestamp now);
  void plan_search(Timestamp now);
  Region search_region(Timestamp now) const;
  PuckEstimate estimate(const SurfaceSnapshot& snapshot) const;

  SensorSize sensor_;
  PuckPipelineParams params_;
  PuckSizeModel size_model_;
  KernelBank kernels_;
  PuckTracker tracker_;
  PixelMotion motion_;

  TrackState state_ = TrackState::kSearching;
  Region region_;  // ROI_t of the next step; empty while there is no track
  Region search_;  // wanted now; empty: none
  Region looked_at_;
  Region detection_region_;
  Pixel position_;
  double score_ = 0;
  bool coasting_ = false;
  std::optional<Pixel> left_image_;
  Timestamp last_good_;  // time of the last strong evidence
  Timestamp resting_since_;
  Timestamp now_;
  Timestamp next_search_;
  std::int64_t events_seen_ = -1;  // of the last snapshot; none before the first
};

}  // namespace puck
