#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/events/timestamp.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/geometry/region.h"

namespace puck {

enum class TrackState : std::uint8_t {
  kSearching,  ///< Never seen yet.
  kTracking,   ///< Followed; also while it rests, or is predicted for at most 50 ms.
  kLost,       ///< Was followed; is being searched for.
};

/// `searching`, `tracking` or `lost`: the words in the tools' output and in CSV files.
const char* to_string(TrackState state);

/// Estimate of the puck after one step of the tracking thread.
struct PuckEstimate {
  TrackState state = TrackState::kSearching;
  bool resting = false;             ///< Held in its place without new events.
  bool coasting = false;            ///< Predicted, not seen, for at most 50 ms.
  std::optional<Pixel> left_image;  ///< Place of exit, if it left the image.

  /// Centre of the puck; empty before the first detection and while lost.
  std::optional<Pixel> position;
  PixelVelocity velocity;
  PuckSize size;
  /// Preset `default`: probability that the puck is visible there. Others: similarity of the
  /// surface to a puck there: 0 none, 1 perfect, comparable at every size.
  double score = 0;
  /// Covariance of (x, y, vx, vy), row by row; px², px²/s, px²/s².
  std::array<double, 16> covariance{};

  Region region;  ///< ROI_d or ROI_t of the step; empty between searches; `default`: the image.
  Timestamp newest_event;           ///< Newest event on the step's surface.
  std::int64_t events_applied = 0;  ///< Events applied to that surface since the start.
};

}  // namespace puck
