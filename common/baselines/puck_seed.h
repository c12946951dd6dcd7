#pragma once

#include <algorithm>

#include "common/events/sensor_size.h"
#include "common/vision/puck_size_model.h"

namespace puck {

/// What a baseline starts from: where PUCK detected the puck, and how large it must be there.
struct PuckSeed {
  Pixel position;
  PuckSize size;
};

/// The size that the model gives at a position, kept to what a puck on any sensor can have; a model
/// that gives no number gives the smallest.
inline PuckSize usable_size_at(const PuckSizeModel& model, Pixel position) {
  const auto usable = [](double size_px) {
    return size_px >= 3 ? std::min<double>(size_px, SensorSize::kMax) : 3;
  };
  const PuckSize size = model.at(position);
  return {usable(size.width), usable(size.height)};
}

}  // namespace puck
