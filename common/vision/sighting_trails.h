#pragma once

#include <cstdint>
#include <vector>

#include "common/vision/background.h"
#include "common/vision/pixel.h"
#include "common/vision/puck_contour.h"
#include "common/vision/sighting_trail.h"
#include "common/vision/tracking_pipeline.h"

namespace puck {

/// Ingredient `sighting-trails`. Links what successive searches found. A single one finds dozens of
/// places that look somewhat like a puck, and a faint one is seldom the first of them; but it goes
/// its way steadily, and there it is found each time, to a pixel, while clutter comes and goes. One
/// thread at a time; asks for no memory once it has been made.
class SightingTrails {
 public:
  SightingTrails();

  /// Takes what a search found, and fills in the trail of each candidate. `background` knows how
  /// what stands still moves, if `head_rests` does not say that it does not. Of two searches within
  /// 2 ms, which see the same, the later one adds nothing.
  void take(SearchResult& found, const PuckContour& contour, const Background& background,
            bool head_rests);

 private:
  struct Trail {
    Pixel position;  // smoothed, of the calibrated wall
    PixelVelocity velocity;
    Pixel own;                 // how far it has moved by itself of late, px
    std::int64_t seen_us = 0;  // when `position` was
    int sightings = 1;
    int missed = 0;
    double score = 0;
    double square = 0;  // of the distance from where it was expected, on average
  };
  struct Seen {
    Pixel position;  // of the calibrated wall
    double score = 0;
    const Trail* trail = nullptr;  // whose it is
  };

  static SightingTrail told(const Trail& trail);

  void follow(Trail& trail, const Region& searched, const Background& background, bool head_rests);
  Seen* nearest(Pixel expected, double within_px);

  std::vector<Trail> trails_;
  std::vector<Seen> seen_;
  std::int64_t time_us_ = 0;
};

}  // namespace puck
