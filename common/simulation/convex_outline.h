#pragma once

#include <vector>

#include "common/vision/pixel.h"

namespace puck {

/// Columns from `begin` up to, but not including, `end`.
struct Columns {
  int begin = 0;
  int end = 0;

  bool empty() const { return begin >= end; }
};

/// The convex hull of some points, as rows of pixels: which of them it may touch, and which lie in
/// it whole. Both answers keep a distance of a pixel from its edge, room for the edge's blur.
class ConvexOutline {
 public:
  /// Only the rows from 0 to `image_height` − 1 are kept, and columns of ±100,000.
  ConvexOutline(std::vector<Pixel> points, int image_height);

  int first_row() const { return first_row_; }
  int end_row() const { return first_row_ + static_cast<int>(touched_.size()); }
  /// Pixels beyond these are not touched at all.
  Columns touched(int y) const;
  /// Pixels of these are covered to the last bit; often none.
  Columns inside(int y) const;

 private:
  int first_row_ = 0;
  std::vector<Columns> touched_;
  std::vector<Columns> inside_;
};

}  // namespace puck
