#pragma once

#include <memory>

#include "common/events/sensor_size.h"
#include "common/vision/puck_pipeline.h"
#include "common/vision/puck_size_model.h"
#include "common/vision/tracking_pipeline.h"

namespace puck {

/// Creates the pipeline that the parameters (of a preset) select. Throws std::invalid_argument,
/// naming the key, when a parameter is out of range.
std::unique_ptr<TrackingPipeline> make_pipeline(SensorSize sensor, const PipelineParams& params,
                                                const PuckSizeModel& size_model);

}  // namespace puck
