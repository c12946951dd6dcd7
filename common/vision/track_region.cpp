#include "common/vision/track_region.h"

#include <algorithm>

namespace puck {

Region region_of_tracks(const ContourTrack& main, const Challengers& challengers, Pixel witness,
                        const PuckContour& contour, SensorSize sensor) {
  double left = witness.x, right = left;
  double top = witness.y, bottom = top;
  double width = contour.size_at(witness).width;
  const auto include = [&](const ContourTrack& track) {
    const Pixel position = track.filter().position();
    left = std::min(left, position.x);
    right = std::max(right, position.x);
    top = std::min(top, position.y);
    bottom = std::max(bottom, position.y);
    width = std::max(width, contour.size_at(position).width);
  };
  include(main);
  for (const Challenger& challenger : challengers) include(challenger.track());
  const int margin = static_cast<int>(1.2 * width + 30);
  return Region{static_cast<int>(left), static_cast<int>(top), static_cast<int>(right - left) + 1,
                static_cast<int>(bottom - top) + 1}
      .inflated(margin)
      .intersect(Region::all_of(sensor));
}

}  // namespace puck
