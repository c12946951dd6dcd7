#include "common/vision/make_pipeline.h"

#include "common/vision/contour_pipeline.h"
#include "common/vision/puck_detector.h"

namespace puck {

std::unique_ptr<TrackingPipeline> make_pipeline(SensorSize sensor, const PipelineParams& params,
                                                const PuckSizeModel& size_model) {
  const PuckSizeModel sizes = params.sizes_of(size_model);
  if (params.follows_contour) {
    return std::make_unique<ContourPipeline>(sensor, params.contour,
                                             detection_region(sensor, params.detector), sizes);
  }
  return std::make_unique<PuckPipeline>(sensor, params, sizes);
}

}  // namespace puck
