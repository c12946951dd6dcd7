#pragma once

#include <vector>

#include "common/simulation/projected_shape.h"

namespace puck {

/// Shapes that move together: the puck; an arm with the knob that it holds. The first one hides the
/// ones after it.
struct SceneBody {
  std::vector<SceneShape> shapes;
};

/// Lays bodies over each other along some columns of a row, the nearest first.
class RowBlend {
 public:
  explicit RowBlend(int width);

  void start(int y, Columns columns);
  /// One that is hidden by all before it.
  void add(const SceneBody& body);
  /// ln(luminance) of a pixel, with `background` behind what has been added.
  float log_light_over(int x, float background) const;

 private:
  /// Share of what the shape before has left of a pixel that this one, which holds it, covers.
  float beyond_before(std::size_t x) const;

  int y_ = 0;
  Columns columns_;
  std::vector<float> light_;      ///< Of what covers each pixel, times its share.
  std::vector<float> left_over_;  ///< Share of each pixel that nothing covers.
  std::vector<float> shares_;     ///< Scratch: the present shape's, and the one's before.
  std::vector<float> shares_before_;
};

}  // namespace puck
