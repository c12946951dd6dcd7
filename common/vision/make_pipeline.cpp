#include "common/vision/make_pipeline.h"

namespace puck {

std::unique_ptr<TrackingPipeline> make_pipeline(SensorSize sensor, const PipelineParams& params,
                                                const PuckSizeModel& size_model) {
  return std::make_unique<PuckPipeline>(sensor, params, size_model);
}

}  // namespace puck
