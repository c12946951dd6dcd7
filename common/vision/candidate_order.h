#pragma once

#include <vector>

#include "common/vision/background.h"
#include "common/vision/puck_contour.h"
#include "common/vision/tracking_pipeline.h"

namespace puck {

/// Of what a search has found, what lies on the background is tried when there is nothing else: it
/// is likely a part of it. Otherwise the order stays.
void put_still_last(std::vector<SearchCandidate>& candidates, const Background& background,
                    const PuckContour& contour);

}  // namespace puck
