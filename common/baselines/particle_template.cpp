#include "common/baselines/particle_template.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr int kReferenceHalf = 15;
constexpr double kReferenceSemiHeight = 7.5;
constexpr double kFlattestAspect = 0.1;
// A change of 0.01 moves the contour by 0.14 template px at most.
constexpr double kVisibleChange = 0.01;

}  // namespace

ParticleTemplate::ParticleTemplate(TemplateShape shape)
    : shape_(shape),
      half_(shape == TemplateShape::kReference ? kReferenceHalf : kLargestHalf),
      aspect_(shape == TemplateShape::kReference ? kReferenceSemiHeight / kSemiWidth : 1) {
  draw();
}

void ParticleTemplate::fit(PuckSize puck) {
  if (shape_ == TemplateShape::kReference) return;
  const double aspect = std::clamp(puck.height / puck.width, kFlattestAspect, 1.0);
  if (std::abs(aspect - aspect_) < kVisibleChange) return;
  aspect_ = aspect;
  draw();
}

void ParticleTemplate::draw() {
  positive_ = 0;
  negative_ = 0;
  for (int row = 0; row < side(); ++row) {
    for (int column = 0; column < side(); ++column) {
      const double x = (column - half_) / kSemiWidth;
      const double y = (row - half_) / (kSemiWidth * aspect_);
      // The authors' measure squares the squares once more, hence the squircle; both measures are 1
      // on the contour and have the ring's borders in the same places on the axes.
      const double measure = shape_ == TemplateShape::kReference
                                 ? std::sqrt(x * x * x * x + y * y * y * y)
                                 : x * x + y * y;
      std::int8_t value = 0;
      if (measure <= 0.5) {
        value = -2;
        ++negative_;
      } else if (measure < 1.5) {
        value = 1;
        ++positive_;
      }
      values_[static_cast<std::size_t>(row * side() + column)] = value;
    }
  }
}

}  // namespace puck
