#include "common/vision/make_pipeline.h"

#include <stdexcept>
#include <string>

#include "common/vision/hypotheses/evidence_pipeline.h"
#include "common/vision/paper/puck_detector.h"

namespace puck {

std::unique_ptr<TrackingPipeline> make_pipeline(SensorSize sensor, const PipelineParams& params,
                                                const PuckSizeModel& size_model) {
  const PuckSizeModel sizes = params.sizes_of(size_model);
  const Region region = detection_region(sensor, params.detector);
  if (params.follows_contour) {
    if (params.surface != SurfaceKind::kEros) {
      throw std::invalid_argument(std::string("tracker.surface: preset default needs eros; ") +
                                  "correlation, paper and reference also take " +
                                  to_string(params.surface));
    }
    return std::make_unique<EvidencePipeline>(sensor,
                                              EvidencePipelineParams{.calibration = params.contour,
                                                                     .evidence = params.evidence,
                                                                     .decision = params.decision},
                                              region, sizes);
  }
  return std::make_unique<PuckPipeline>(sensor, params, sizes);
}

}  // namespace puck
