#pragma once

#include <vector>

#include "common/vision/background.h"
#include "common/vision/puck_contour.h"
#include "common/vision/tracking_pipeline.h"

namespace puck {

/// A faint puck that slides along a rail lies on the background, but few things look as much like a
/// ring as it does.
inline constexpr double kClearRingScore = 0.6;

/// Of what a search has found, what lies on the background is tried when there is nothing else: it
/// is likely a part of it. What scores more than `clear_score` keeps its place wherever it lies.
/// Otherwise the order stays.
void put_still_last(SearchResult& found, const Background& background, const PuckContour& contour,
                    double clear_score = 1);

/// What has left a likely trail is tried before all else, wherever it lies. Otherwise the order
/// stays.
void put_followed_first(SearchResult& found);

}  // namespace puck
