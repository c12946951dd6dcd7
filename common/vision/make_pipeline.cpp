#include "common/vision/make_pipeline.h"

#include "common/vision/contour_pipeline.h"
#include "common/vision/evidence_pipeline.h"
#include "common/vision/puck_detector.h"

namespace puck {

std::unique_ptr<TrackingPipeline> make_pipeline(SensorSize sensor, const PipelineParams& params,
                                                const PuckSizeModel& size_model) {
  const PuckSizeModel sizes = params.sizes_of(size_model);
  const Region region = detection_region(sensor, params.detector);
  if (params.weighs_evidence) {
    return std::make_unique<EvidencePipeline>(
        sensor, EvidencePipelineParams{.calibration = params.contour.calibration}, region, sizes);
  }
  if (params.follows_contour) {
    return std::make_unique<ContourPipeline>(sensor, params.contour, region, sizes);
  }
  return std::make_unique<PuckPipeline>(sensor, params, sizes);
}

}  // namespace puck
