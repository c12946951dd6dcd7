#pragma once

#include <vector>

#include "common/vision/geometry/pixel.h"

namespace puck {

/// Columns from `begin` up to, but not including, `end`.
struct Columns {
  int begin = 0;
  int end = 0;

  bool empty() const { return begin >= end; }
};

/// The convex hull of some points as rows of pixels: which pixels it may touch, and which lie
/// wholly inside. Both leave a margin of one pixel around the edge for the edge's blur.
class ConvexOutline {
 public:
  /// Keeps only the rows from 0 to `image_height` − 1, and columns of ±100,000.
  ConvexOutline(std::vector<Pixel> points, int image_height);

  int first_row() const { return first_row_; }
  int end_row() const { return first_row_ + static_cast<int>(touched_.size()); }
  /// Columns outside these are not covered.
  Columns touched(int y) const;
  /// Columns that are fully covered; often none.
  Columns inside(int y) const;

 private:
  int first_row_ = 0;
  std::vector<Columns> touched_;
  std::vector<Columns> inside_;
};

}  // namespace puck
