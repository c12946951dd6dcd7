#include "common/simulation/row_blend.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

// A pixel with more than this share covered is opaque.
constexpr float kOpaque = 0.9995f;

}  // namespace

RowBlend::RowBlend(int width)
    : light_(static_cast<std::size_t>(width)),
      uncovered_(static_cast<std::size_t>(width)),
      shares_(static_cast<std::size_t>(width)),
      shares_before_(static_cast<std::size_t>(width)) {}

void RowBlend::start(int y, Columns columns) {
  y_ = y;
  columns_ = columns;
  std::fill(light_.begin() + columns.begin, light_.begin() + columns.end, 0.0f);
  std::fill(uncovered_.begin() + columns.begin, uncovered_.begin() + columns.end, 1.0f);
}

void RowBlend::add(const SceneBody& body) {
  Columns before;  // Columns for which `shares_before_` holds the previous shape's shares.
  for (const SceneShape& shape : body.shapes) {
    const Columns touched = shape.outline().touched(y_);
    const int begin = std::max(columns_.begin, touched.begin);
    const int end = std::min(columns_.end, touched.end);
    if (begin >= end) {
      before = {};
      continue;
    }
    const Columns inside = shape.outline().inside(y_);
    const int inside_begin = inside.empty() ? end : std::clamp(inside.begin, begin, end);
    const int inside_end = inside.empty() ? end : std::clamp(inside.end, inside_begin, end);
    float* shares = shares_.data();
    shape.coverage(y_, begin, inside_begin - begin, shares + begin);
    std::fill(shares + inside_begin, shares + inside_end, 1.0f);
    shape.coverage(y_, inside_end, end - inside_end, shares + inside_end);
    if (!shape.holds_previous) before = {};
    for (int i = begin; i < end; ++i) {
      const auto x = static_cast<std::size_t>(i);
      const bool is_beyond = i >= before.begin && i < before.end;
      const float share = uncovered_[x] * (is_beyond ? beyond_before(x) : shares[i]);
      light_[x] += share * shape.luminance;
      uncovered_[x] -= share;
    }
    before = {begin, end};
    shares_.swap(shares_before_);
  }
}

// The previous shape covers part of the pixel; this one, which contains it, adds the difference of
// their shares, relative to the part left uncovered.
float RowBlend::beyond_before(std::size_t x) const {
  const float left = 1 - shares_before_[x];
  return left > 0 ? std::max(0.0f, (shares_[x] - shares_before_[x]) / left) : 0;
}

float RowBlend::log_light_over(int x, float background) const {
  const auto at = static_cast<std::size_t>(x);
  if (uncovered_[at] >= kOpaque) return background;
  if (uncovered_[at] < 1 - kOpaque) return std::log(light_[at]);
  return std::log(light_[at] + uncovered_[at] * std::exp(background));
}

}  // namespace puck
