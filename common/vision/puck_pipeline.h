#pragma once

#include <cstdint>

#include "common/events/sensor_size.h"
#include "common/vision/correlation.h"
#include "common/vision/eros_surface.h"
#include "common/vision/gaussian_blur.h"
#include "common/vision/kernel_bank.h"
#include "common/vision/pixel_motion.h"
#include "common/vision/puck_detector.h"
#include "common/vision/puck_estimate.h"
#include "common/vision/puck_size_model.h"
#include "common/vision/puck_tracker.h"
#include "common/vision/surface_snapshot.h"

namespace puck {

/// When a track counts as lost and how the puck is searched for again.
struct LossParams {
  /// Off: once detected the puck is tracked for ever, as in the paper.
  bool enabled = true;
  /// A place that scores less is weak evidence.
  double lowest_score = 0.36;
  /// How long weak evidence is followed, while something better is looked for around it, before the
  /// puck counts as lost, sensor time.
  std::int64_t coast_us = 50'000;
  /// Sensor time between searches.
  std::int64_t search_period_us = 5'000;
  /// The search reaches this far around where the puck was expected last, at first …
  double search_radius_px = 40;
  /// … and this much farther each second, until it covers the whole image.
  double search_growth_px_s = 3'000;
};

struct PipelineParams {
  ErosParams eros;
  KernelBankParams kernels;
  DetectorParams detector;
  TrackerParams tracker;
  PixelMotionParams motion;
  LossParams loss;
  /// The Gaussian and the window are centred on the predicted position instead of the last one, and
  /// the published position is the filtered one.
  bool predicts = false;
};

/// What the paper's second thread does: detect, then track, one step for each look at the surface.
/// A plain object without thread, clock or surface of its own, so that the tracker service, the
/// evaluation and the tests all run the same:
///
///     surface.snapshot(pipeline.region_needed(), snapshot);
///     const PuckEstimate estimate = pipeline.step(snapshot);
///
/// The same snapshots give the same estimates, to the bit. One thread at a time.
class PuckPipeline {
 public:
  /// Throws std::invalid_argument, naming the key, when a parameter is out of range.
  PuckPipeline(SensorSize sensor, const PipelineParams& params, const PuckSizeModel& size_model);

  /// The part of the surface that the next step looks at; empty while it waits for its next search.
  Region region_needed() const;

  /// Detects or tracks on a snapshot of `region_needed()`.
  PuckEstimate step(const SurfaceSnapshot& snapshot);

  TrackState state() const { return state_; }

 private:
  void track(Timestamp now);
  void coast(Timestamp now);
  void search(Timestamp now);
  void begin_track(Pixel position, Timestamp now);
  void lose(Timestamp now);
  void plan_search(Timestamp now);
  Region search_region(Timestamp now) const;
  int kernel_reach(const Region& region) const;
  PuckEstimate estimate(const SurfaceSnapshot& snapshot, const Region& looked_at) const;

  SensorSize sensor_;
  PipelineParams params_;
  PuckSizeModel size_model_;
  KernelBank kernels_;
  PuckDetector detector_;
  PuckTracker tracker_;
  PixelMotion motion_;
  GaussianBlur blur_;
  Correlation picture_;
  Image<std::uint8_t> blurred_;

  TrackState state_ = TrackState::kSearching;
  Region region_;  // ROI_d or ROI_t of the next step
  Pixel position_;
  double score_ = 0;
  bool coasting_ = false;
  std::optional<Pixel> left_image_;
  Timestamp last_good_;  // when the track was last believed
  Timestamp resting_since_;
  Timestamp next_search_;
  std::int64_t events_seen_ = -1;  // of the last snapshot; none before the first
};

}  // namespace puck
