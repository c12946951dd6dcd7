#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/vision/contour/puck_contour.h"
#include "common/vision/geometry/image.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// A pixel near the puck's ring.
struct RingSample {
  float distance_px = 0;  ///< From the ring, positive outside.
  float normal_x = 0;     ///< Unit vector out of the puck there.
  float normal_y = 0;
  float grey = 0;
  int sector = 0;  ///< Which of kContourSectors, seen from the centre.
};

/// The pixels of a picture within `kReachPx` of a ring, and the sum of those farther inside.
class RingSamples {
 public:
  static constexpr double kReachPx = 4;

  /// How far to each side of the puck's centre pixels are looked at, at most, px.
  static double reach_x(const ContourRing& ring);
  static double reach_y(const ContourRing& ring);

  /// Looks at the ring of a puck at `centre`. `place` is where the picture lies in the image; what
  /// lies outside it is not known, which is not the same as dark.
  void gather(ImageView<const std::uint8_t> picture, const Region& place, const ContourRing& ring,
              Pixel centre);

  const std::vector<RingSample>& near() const { return near_; }
  /// Those of near() that are not dark.
  std::span<const RingSample> bright() const { return std::span(near_).first(bright_); }
  double inside_sum() const { return inside_sum_; }
  int inside_pixels() const { return inside_pixels_; }

 private:
  std::vector<RingSample> near_;  // bright ones first
  std::size_t bright_ = 0;
  double inside_sum_ = 0;
  int inside_pixels_ = 0;
};

}  // namespace puck
