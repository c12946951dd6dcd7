#pragma once

#include <cstdint>

#include "common/events/timestamp.h"
#include "common/vision/geometry/image.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// A copy of a part of a surface, for the tracking thread.
struct SurfaceSnapshot {
  Region region;                    ///< Place of `grey`: inside the sensor, maybe empty.
  Image<std::uint8_t> grey;         ///< 0: no recent event; 255: an event and none near it since.
  Timestamp newest_event;           ///< Newest event on the surface when the copy was made.
  std::int64_t events_applied = 0;  ///< Events applied to the surface until then.

  /// The view of `part`, which lies inside `region`.
  ImageView<std::uint8_t> picture_of(const Region& part) {
    return grey.mutable_view().part(part.x - region.x, part.y - region.y, part.width, part.height);
  }
};

}  // namespace puck
