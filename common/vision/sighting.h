#pragma once

#include <optional>

#include "common/vision/puck_contour.h"
#include "common/vision/tracking_pipeline.h"

namespace puck {

/// Where a search saw the puck, if it did so near a track at `main` that believes `wall_share`: the
/// place that looked most like it, as that track would have it. What is near a poor track and looks
/// like the puck is it, however few its events; where it is not, the track hardly ever is, either.
std::optional<Pixel> sighting_near(Pixel main, double wall_share, const SearchResult& result,
                                   const PuckContour& contour);

}  // namespace puck
