#pragma once

#include <vector>

#include "common/simulation/projected_shape.h"

namespace puck {

/// Shapes that move together, such as the puck, or an arm with the knob that it holds. The first
/// shape is in front.
struct SceneBody {
  std::vector<SceneShape> shapes;
};

/// Composites bodies along some columns of a row, front to back.
class RowBlend {
 public:
  explicit RowBlend(int width);

  void start(int y, Columns columns);
  /// Adds a body behind all bodies added before.
  void add(const SceneBody& body);
  /// ln(luminance) of a pixel, with `background` behind the added bodies.
  float log_light_over(int x, float background) const;

 private:
  /// Share of the pixel part left by the previous shape that this one, which contains it, covers.
  float beyond_before(std::size_t x) const;

  int y_ = 0;
  Columns columns_;
  std::vector<float> light_;      ///< Luminance times share of the bodies so far.
  std::vector<float> uncovered_;  ///< Share of each pixel that is not covered yet.
  std::vector<float> shares_;     ///< Scratch: of the present shape, then of the previous one.
  std::vector<float> shares_before_;
};

}  // namespace puck
