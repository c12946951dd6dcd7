#pragma once

#include <optional>
#include <string>

#include "tools/view/drawing/camera_picture.h"
#include "tools/view/drawing/canvas.h"

namespace puck {

/// The time by which the arrow of the velocity is ahead.
inline constexpr double kArrow_s = 0.05;

/// "tracking", "tracking, at rest", "coasting", "lost for 0.32 s", "searching", …
std::string state_words(const ViewTrack& track, Timestamp now);

/// Whether the track is not believed: not `tracking`, or coasting.
bool is_doubtful(const PuckEstimate& estimate);

/// Whether there is a region smaller than the image.
bool has_region(const ViewTrack& track, SensorSize sensor);

/// Error of the estimate against truth, px; empty without one of the two, or while the puck is
/// hidden.
std::optional<double> error_px(const ViewTrack& track, const std::optional<TruthRow>& truth);

/// Draws the layers that the wishes show: regions, trail, truth, covariance, ellipse, velocity. A
/// doubtful track is dashed, faded, and named in a word beside it.
void draw_track(const ViewScene& scene, const PictureWishes& wishes, const SensorFrame& frame,
                Canvas& canvas);

}  // namespace puck
