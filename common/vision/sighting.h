#pragma once

#include <optional>

#include "common/vision/puck_contour.h"
#include "common/vision/tracking_pipeline.h"

namespace puck {

/// Where a search saw the puck.
struct Sighting {
  Pixel place;              ///< As the track would have it.
  bool is_sure = false;     ///< By its score, or its trail.
  bool is_certain = false;  ///< SightingTrail's.
};

/// Where a search saw the puck, if it did so near a track at `main` that believes `wall_share`: the
/// place that looked most like it. What is near a poor track and looks like the puck is it, however
/// few its events; where it is not, the track hardly ever is, either. What has left a steady trail
/// need not look as much like it.
std::optional<Sighting> sighting_near(Pixel main, double wall_share, const SearchResult& result,
                                      const PuckContour& contour);

}  // namespace puck
