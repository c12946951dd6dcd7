#pragma once

#include "common/table/table_point.h"
#include "common/vision/pixel.h"

namespace puck {

/// One place seen in the image and measured on the table.
struct Correspondence {
  Pixel image;
  TablePoint table;
};

}  // namespace puck
