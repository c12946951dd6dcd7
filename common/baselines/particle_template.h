#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/vision/geometry/pixel.h"

namespace puck {

enum class TemplateShape : std::uint8_t {
  kEllipse,    ///< An upright ellipse with the puck's own aspect ratio.
  kReference,  ///< The authors': a squircle 1.9 times as wide as high, cut off left and right.
};

/// The weights of a particle's observation, drawn on a grid around the puck's centre: +1 on a broad
/// ring along the contour, −2 inside, 0 outside. A particle of radius R px scales it by 15 / R; the
/// radius is slightly more than half the puck's width, as in the authors' code.
class ParticleTemplate {
 public:
  static constexpr double kBaseRadius = 15;
  static constexpr double kSemiWidth = 14.25;

  /// The ellipse starts as a circle.
  explicit ParticleTemplate(TemplateShape shape);

  /// Redraws the ellipse when the puck's aspect ratio has changed visibly; a puck no wider than
  /// high is drawn as a circle. The reference shape stays as it is.
  void fit(PuckSize puck);

  /// The value at an offset from the puck's centre, in template px; `std::nullopt` beyond the grid.
  std::optional<int> at(double dx, double dy) const {
    const double column = dx + half_ + 0.5;
    const double row = dy + half_ + 0.5;
    if (!(column >= 0 && column < side() && row >= 0 && row < side())) return std::nullopt;
    return values_[static_cast<std::size_t>(static_cast<int>(row) * side() +
                                            static_cast<int>(column))];
  }

  /// Columns (or rows) from the centre to the border of the grid.
  int half_side() const { return half_; }
  int positive_pixels() const { return positive_; }
  int negative_pixels() const { return negative_; }

  static double radius_of_width(double width_px) {
    return width_px / 2 * (kBaseRadius / kSemiWidth);
  }
  PuckSize size_of_radius(double radius_px) const {
    const double width_px = 2 * radius_px * (kSemiWidth / kBaseRadius);
    return {width_px, width_px * aspect_};
  }

 private:
  // Room for the ellipse's whole ring: 14.25·√1.5 px to either side.
  static constexpr int kLargestHalf = 18;
  static constexpr int kLargestSide = 2 * kLargestHalf + 1;

  int side() const { return 2 * half_ + 1; }
  void draw();

  TemplateShape shape_;
  int half_;
  double aspect_;  // height of the contour / width
  std::array<std::int8_t, kLargestSide * kLargestSide> values_{};
  int positive_ = 0;
  int negative_ = 0;
};

}  // namespace puck
