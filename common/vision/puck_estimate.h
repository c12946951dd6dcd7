#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/events/timestamp.h"
#include "common/vision/pixel.h"
#include "common/vision/region.h"

namespace puck {

enum class TrackState : std::uint8_t {
  kSearching,  ///< Never seen yet.
  kTracking,   ///< Followed; also while it rests, or is predicted for at most 50 ms.
  kLost,       ///< Was followed; is being searched for.
};

/// `searching`, `tracking` or `lost`: the words used on the wire's tools and in CSV.
const char* to_string(TrackState state);

/// Where the puck is believed to be, after one step of the tracking thread.
struct PuckEstimate {
  TrackState state = TrackState::kSearching;
  bool resting = false;             ///< Held in its place without new events.
  bool coasting = false;            ///< Predicted, not seen, for at most 50 ms.
  std::optional<Pixel> left_image;  ///< Where it left the image, if it did.

  /// Centre of the puck; nothing while it has never been seen or is lost.
  std::optional<Pixel> position;
  PixelVelocity velocity;
  PuckSize size;
  /// How much the surface looks like a puck there: 0 not at all, 1 perfectly, alike at every size.
  double score = 0;
  /// Of (x, y, vx, vy), row by row; px², px²/s, px²/s².
  std::array<double, 16> covariance{};

  Region region;                    ///< ROI_d or ROI_t that was looked at; empty between searches.
  Timestamp newest_event;           ///< Newest event on the surface that was looked at.
  std::int64_t events_applied = 0;  ///< Events applied to that surface since the start.
};

}  // namespace puck
