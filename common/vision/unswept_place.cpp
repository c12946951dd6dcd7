#include "common/vision/unswept_place.h"

#include <cmath>
#include <numbers>

namespace puck {
namespace {

// Of the events that a passing edge makes: noise and what only grazes the place make some as well.
constexpr double kFewOfExpected = 0.2;
// Fewer missing events may be chance, and so may a lesser part of those that are to be expected.
constexpr double kSurelyMissing = 15;
constexpr double kMostlyMissing = 0.4;
// How far from the disc's middle that of a part is.
constexpr double kMiddleOfPart = 0.5;

}  // namespace

void UnsweptPlace::put(Pixel position, const ContourRing& ring) {
  is_known_ = true;
  position_ = position;
  ring_ = ring;
  per_semi_x_ = 1 / ring.semi_x;
  per_semi_y_ = 1 / ring.semi_y;
  events_ = {};
}

bool UnsweptPlace::must_hold_puck(double density) const {
  return is_unswept(density, {true, true, true, true});
}

bool UnsweptPlace::must_hold_puck(double density, Pixel elsewhere) const {
  const double dy = elsewhere.y - position_.y;
  const double u = (elsewhere.x - position_.x - ring_.shear * dy) * per_semi_x_;
  const double v = dy * per_semi_y_;
  const auto is_left = [&](double part_u, double part_v) {
    return std::hypot(part_u * kMiddleOfPart - u, part_v * kMiddleOfPart - v) > 1;
  };
  return is_unswept(density, {is_left(-1, 0), is_left(1, 0), is_left(0, -1), is_left(0, 1)});
}

bool UnsweptPlace::is_unswept(double density, const Parts& left) const {
  if (!is_known_) return false;
  const double expected =
      density * kInner * kInner * std::numbers::pi * ring_.semi_x * ring_.semi_y / double{kParts};
  double all = 0;
  double missing = 0;
  for (std::size_t i = 0; i < kParts; ++i) {
    if (!left[i]) continue;
    all += expected;
    if (events_[i] < kFewOfExpected * expected) missing += expected;
  }
  return missing > kSurelyMissing && missing > kMostlyMissing * all;
}

Region UnsweptPlace::region() const {
  if (!is_known_) return {};
  return Region::around({position_.x, position_.y - ring_.rise},
                        2 * static_cast<int>(ring_.half_width()) + 3,
                        2 * static_cast<int>(ring_.semi_y) + 3);
}

}  // namespace puck
