#pragma once

#include <span>
#include <vector>

#include "common/io/annotation_file.h"
#include "common/io/truth_file.h"

namespace puck {

/// Up to `count` rows with a fully visible puck, spread over the image, with a box rounded to half
/// a pixel as in manual annotations. In order of time.
std::vector<Annotation> spread_marks(std::span<const TruthRow> truth, int count);

}  // namespace puck
