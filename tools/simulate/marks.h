#pragma once

#include <span>
#include <vector>

#include "common/io/annotation_file.h"
#include "common/io/truth_file.h"

namespace puck {

/// Up to `count` rows in which the whole puck is seen, as far apart in the image as can be, as a
/// person would mark them: the edges of the box to half a pixel. In the order of their times.
std::vector<Annotation> spread_marks(std::span<const TruthRow> truth, int count);

}  // namespace puck
