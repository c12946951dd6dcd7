#pragma once

#include "common/events/sensor_size.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/geometry/region.h"

namespace puck::test {

inline constexpr SensorSize kSensor{640, 480};
inline constexpr Region kImage = Region::all_of(kSensor);
// About the authors' model: 29×20 px in the middle of their detection region.
inline constexpr PuckSizeModel kSizeModel{14, 0, 0.077, 5, 0, 0.077};

}  // namespace puck::test
