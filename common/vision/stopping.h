#pragma once

#include "common/events/sensor_size.h"
#include "common/vision/contour_track.h"

namespace puck {

/// A moving puck makes events. When it should have made a good many since the last and nothing else
/// has happened around it, it has stopped where it was. Switched by ContourIngredients::stopping.
void stop_if_silent(ContourTrack& track, const ContourContext& context, std::int64_t time_us);

/// A track cannot be followed far beyond the image: stops it 15 px outside, and says so.
bool stop_beyond_image(ContourTrack& track, const ContourContext& context, SensorSize sensor,
                       std::int64_t time_us);

}  // namespace puck
