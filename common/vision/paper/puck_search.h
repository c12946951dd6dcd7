#pragma once

#include <optional>

#include "common/events/sensor_size.h"
#include "common/vision/correlation/correlation.h"
#include "common/vision/correlation/kernel_bank.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/interfaces/tracking_pipeline.h"
#include "common/vision/paper/search_params.h"
#include "common/vision/surface/surface_snapshot.h"

namespace puck {

/// Searches a snapshot of the surface for the puck, without knowledge of a track. The same snapshot
/// gives the same result, to the bit. One thread at a time.
class PuckSearch {
 public:
  /// Throws std::invalid_argument, naming the key, when a parameter is out of range.
  PuckSearch(SensorSize sensor, const SearchParams& params, const PuckSizeModel& size_model);

  /// The part of the surface that a search of `search` needs: with the reach of kernels on its
  /// border and that of the blur.
  Region snapshot_region(const Region& search) const;

  /// Looks for the puck. `snapshot` shows snapshot_region(request.region).
  SearchResult search(const SurfaceSnapshot& snapshot, const SearchRequest& request);

 private:
  /// Appearance of a puck under one of the two assumptions on its side wall.
  struct Look {
    Look(SensorSize sensor, const SearchParams& params, const PuckSizeModel& size_model,
         double kernel_wall_share, bool other_wall);

    PuckSizeModel contour_size;  ///< Of the contour that the kernels show.
    double rise_of_width;        ///< Height of its centre above the puck's.
    PuckDetector detector;
    std::optional<SoftRing> ring;
  };

  SearchCandidate candidate_at(const SurfaceSnapshot& snapshot, Look& look, Pixel detected);

  SensorSize sensor_;
  KernelBank kernels_;
  Look calibrated_;
  Look other_wall_;
  Correlation picture_;
};

}  // namespace puck
