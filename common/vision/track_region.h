#pragma once

#include "common/events/sensor_size.h"
#include "common/vision/challengers.h"
#include "common/vision/contour_track.h"
#include "common/vision/region.h"

namespace puck {

/// The part of the image, inside the sensor, whose events the main track, its challengers and the
/// witness need until the next decision.
Region region_of_tracks(const ContourTrack& main, const Challengers& challengers, Pixel witness,
                        const PuckContour& contour, SensorSize sensor);

}  // namespace puck
