#pragma once

#include <cstdint>
#include <vector>

#include "common/vision/sighting_trails.h"
#include "tests/vision/contour_world.h"

namespace puck::test {

/// Between two searches of a walk.
inline constexpr std::int64_t kSearchPeriod_us = 5'000;

/// Of something that goes its way, one a search, until the last finds it at `end`.
struct Walk {
  Pixel end;
  PixelVelocity velocity;
  double score = 0.5;
  int searches = 8;
};

/// Shows a walk under a head that rests to the trails; returns the last search, at `end_us`, with
/// what they have filled in.
inline SearchResult show(SightingTrails& trails, const Walk& walk, const PuckContour& contour,
                         std::int64_t end_us) {
  SearchResult found;
  for (int i = walk.searches - 1; i >= 0; --i) {
    const std::int64_t ago_us = i * kSearchPeriod_us;
    const double ago_s = static_cast<double>(ago_us) * 1e-6;
    found = {{end_us - ago_us},
             {.region = Region::all_of(kSensor)},
             {{{walk.end.x - ago_s * walk.velocity.x, walk.end.y - ago_s * walk.velocity.y},
               walk.score}}};
    trails.take(found, contour, Background(kSensor), true);
  }
  return found;
}

}  // namespace puck::test
