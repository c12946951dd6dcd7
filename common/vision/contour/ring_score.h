#pragma once

#include "common/vision/contour/ring_samples.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// How much a place looks like a puck, 0 to 1, alike at every size and place. In each sector of the
/// ring it is the contrast (r − b) / (r + b + doubt), none below 0: r the ring's grey, weighted
/// less the farther from the contour; b the mean of the inside's and of the outside's there; the
/// doubt as strong as 5 % of full grey, so that a few stray events are no evidence. The score is
/// the geometric mean of the sectors' mean contrast and of how evenly the ring's grey is spread
/// over the sectors, (Σr)² / (n Σr²): an edge or a corner fills some sectors brightly, a puck all
/// of them. Sectors outside the image count as empty ones in the latter.
/// `shift`: where the ring lies relative to where the samples were gathered, up to a few px.
double ring_score(const RingSamples& samples, Pixel shift);

}  // namespace puck
