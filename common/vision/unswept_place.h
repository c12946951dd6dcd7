#pragma once

#include <array>
#include <cstddef>

#include "common/vision/pixel.h"
#include "common/vision/puck_contour.h"
#include "common/vision/region.h"

namespace puck {

/// Where the puck lay, and which parts of its disc there have made events since. It cannot leave
/// without its trailing edge sweeping over the place: where a part lacks the events that this must
/// have made, the puck is still there, whatever a hand or a mallet beside it looks like.
class UnsweptPlace {
 public:
  /// The puck lies here, its contour on this ring, and nothing happens.
  void put(Pixel position, const ContourRing& ring);
  void forget() { is_known_ = false; }

  /// Takes an event; only those in region() count.
  void take(double x, double y) {
    if (!is_known_) return;
    const double dy = y - position_.y + ring_.rise;
    const double u = (x - position_.x - ring_.shear * dy) * per_semi_x_;
    const double v = dy * per_semi_y_;
    if (u * u + v * v < kInner * kInner) ++events_[part_of(u, v)];
  }

  /// Whether the puck must still be here. `density`: how many events a px² its edge makes where it
  /// passes, 0 while that is not known.
  bool must_hold_puck(double density) const;
  /// The same by those parts alone over which the trailing edge has passed if the puck is at
  /// `elsewhere` now.
  bool must_hold_puck(double density, Pixel elsewhere) const;

  Pixel position() const { return position_; }
  /// Empty while no place is known.
  Region region() const;

 private:
  // In units of the contour: not so near it that a puck at rest makes events there.
  static constexpr double kInner = 0.8;
  static constexpr std::size_t kParts = 4;
  using Parts = std::array<bool, kParts>;

  // Left, right, top, bottom.
  static std::size_t part_of(double u, double v) {
    if (v > u) return v > -u ? 3 : 0;
    return v > -u ? 1 : 2;
  }
  bool is_unswept(double density, const Parts& left) const;

  bool is_known_ = false;
  Pixel position_;
  ContourRing ring_;
  double per_semi_x_ = 0;
  double per_semi_y_ = 0;
  std::array<int, kParts> events_{};
};

}  // namespace puck
