#pragma once

#include <memory>

#include "common/events/sensor_size.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/hypotheses/decision_params.h"
#include "common/vision/hypotheses/evidence.h"
#include "common/vision/interfaces/tracking_pipeline.h"
#include "common/vision/paper/puck_pipeline.h"

namespace puck {

/// Settings of any preset's pipeline.
struct PipelineParams : PuckPipelineParams {
  /// EvidencePipeline follows the puck's contour by single events, and correlation only searches
  /// for it, on recently active edges. Of the inherited parameters, only those of the surface, the
  /// kernels, the detector and the soft ring, and the search's delay, are used then.
  bool follows_contour = false;
  EvidenceParams evidence;
  DecisionParams decision;
};

/// Creates the pipeline that the parameters (of a preset) select. Throws std::invalid_argument,
/// naming the key, when a parameter is out of range.
std::unique_ptr<TrackingPipeline> make_pipeline(SensorSize sensor, const PipelineParams& params,
                                                const PuckSizeModel& size_model);

}  // namespace puck
