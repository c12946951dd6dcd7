#pragma once

#include "common/events/sensor_size.h"
#include "common/vision/correlation.h"
#include "common/vision/gaussian_blur.h"
#include "common/vision/kernel_bank.h"
#include "common/vision/puck_detector.h"
#include "common/vision/puck_pipeline.h"
#include "common/vision/puck_size_model.h"
#include "common/vision/soft_ring.h"
#include "common/vision/surface_snapshot.h"
#include "common/vision/tracking_pipeline.h"

namespace puck {

/// Searches a snapshot of the surface for the puck, without knowledge of a track. The same snapshot
/// gives the same result, to the bit. One thread at a time.
class PuckSearch {
 public:
  /// Uses the tracker's kernels and ring. Throws std::invalid_argument, naming the key, when a
  /// parameter is out of range.
  PuckSearch(SensorSize sensor, const PipelineParams& params, const PuckSizeModel& size_model);

  /// The part of the surface that a search of `search` needs: with the reach of kernels on its
  /// border and that of the blur.
  Region snapshot_region(const Region& search) const;

  /// Looks for the puck. `snapshot` shows snapshot_region(request.region).
  SearchResult search(const SurfaceSnapshot& snapshot, const SearchRequest& request);

 private:
  /// Appearance of a puck under one of the two assumptions on its side wall.
  struct Look {
    Look(SensorSize sensor, const PipelineParams& params, const PuckSizeModel& size_model,
         double kernel_wall_share, bool other_wall);

    /// Sets the wall's height for later searches.
    void take_wall(const PuckSizeModel& size_model, double wall_share);

    PuckSizeModel contour_size;  ///< Of the contour that the kernels show.
    double rise_of_width;        ///< Height of its centre above the puck's.
    PuckDetector detector;
    SoftRing ring;
  };

  Look& look_of(const SearchRequest& request);
  SearchCandidate candidate_at(const SurfaceSnapshot& snapshot, Look& look, Pixel detected);

  SensorSize sensor_;
  KernelBank kernels_;
  bool has_ring_;
  PuckSizeModel sizes_;
  double other_wall_share_;  // calibrated, or estimated since
  PuckSizeModel tallest_;    // for the largest height of the other wall
  Look calibrated_;
  Look other_wall_;
  Correlation picture_;
};

}  // namespace puck
