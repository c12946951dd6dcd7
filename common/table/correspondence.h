#pragma once

#include "common/table/table_point.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// A point measured both in the image and on the table.
struct Correspondence {
  Pixel image;
  TablePoint table;
};

}  // namespace puck
