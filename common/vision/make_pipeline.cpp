#include "common/vision/make_pipeline.h"

#include <stdexcept>
#include <string>

namespace puck {
namespace {

std::unique_ptr<TrackingPipeline> make(SensorSize sensor, const HypothesesParams& params,
                                       const PuckSizeModel& size_model) {
  if (params.surface != SurfaceKind::kEros) {
    throw std::invalid_argument(std::string("tracker.surface: preset default needs eros; ") +
                                "correlation, paper and reference also take " +
                                to_string(params.surface));
  }
  return std::make_unique<EvidencePipeline>(sensor, params,
                                            detection_region(sensor, params.detector),
                                            params.sizes_of(size_model), params.contour);
}

std::unique_ptr<TrackingPipeline> make(SensorSize sensor, const PuckPipelineParams& params,
                                       const PuckSizeModel& size_model) {
  return std::make_unique<PuckPipeline>(sensor, params, params.sizes_of(size_model));
}

}  // namespace

SearchParams& search_params(PipelineParams& params) {
  return std::visit([](SearchParams& its) -> SearchParams& { return its; }, params);
}

const SearchParams& search_params(const PipelineParams& params) {
  return std::visit([](const SearchParams& its) -> const SearchParams& { return its; }, params);
}

bool searches_fresh(const PipelineParams& params) {
  return std::holds_alternative<HypothesesParams>(params);
}

bool is_roi_only(const PipelineParams& params) {
  const auto* paper = std::get_if<PuckPipelineParams>(&params);
  return paper != nullptr && paper->roi_only;
}

std::unique_ptr<TrackingPipeline> make_pipeline(SensorSize sensor, const PipelineParams& params,
                                                const PuckSizeModel& size_model) {
  return std::visit([&](const auto& its) { return make(sensor, its, size_model); }, params);
}

}  // namespace puck
