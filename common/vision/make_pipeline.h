#pragma once

#include <memory>
#include <variant>

#include "common/events/sensor_size.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/hypotheses/evidence_pipeline.h"
#include "common/vision/interfaces/tracking_pipeline.h"
#include "common/vision/paper/puck_pipeline.h"

namespace puck {

/// Settings of EvidencePipeline, and of the correlation that searches for it, on recently active
/// edges only (FreshPixels).
struct HypothesesParams : SearchParams, EvidencePipelineParams {};

/// Settings of a tracker, and which pipeline it has.
using PipelineParams = std::variant<HypothesesParams, PuckPipelineParams>;

/// Those of the surface and the searches.
SearchParams& search_params(PipelineParams& params);
const SearchParams& search_params(const PipelineParams& params);

/// Whether searches use recently active edges only.
bool searches_fresh(const PipelineParams& params);

/// Whether only a region of the surface is kept up to date (PuckPipelineParams::roi_only).
bool is_roi_only(const PipelineParams& params);

/// Creates the pipeline. Throws std::invalid_argument, naming the key, when a parameter is out of
/// range.
std::unique_ptr<TrackingPipeline> make_pipeline(SensorSize sensor, const PipelineParams& params,
                                                const PuckSizeModel& size_model);

}  // namespace puck
