#include "common/vision/presets.h"

#include "common/vision/paper/paper_presets.h"

namespace puck {
namespace {

// Correlation searches, contour filters follow. Evidence decides on each candidate of the search,
// so that false candidates are acceptable.
PipelineParams contour() {
  PipelineParams params{correlation_params()};
  params.detector.threshold = 0.2;
  params.follows_contour = true;
  return params;
}

}  // namespace

const char* to_string(Preset preset) {
  switch (preset) {
    case Preset::kPaper:
      return "paper";
    case Preset::kReference:
      return "reference";
    case Preset::kCorrelation:
      return "correlation";
    case Preset::kDefault:
      return "default";
  }
  return "unknown";
}

std::optional<Preset> preset_from(std::string_view name) {
  for (const Preset preset :
       {Preset::kPaper, Preset::kReference, Preset::kCorrelation, Preset::kDefault}) {
    if (name == to_string(preset)) return preset;
  }
  return std::nullopt;
}

PipelineParams preset_params(Preset preset) {
  switch (preset) {
    case Preset::kPaper:
      return {paper_params()};
    case Preset::kReference:
      return {reference_params()};
    case Preset::kCorrelation:
      return {correlation_params()};
    case Preset::kDefault:
      break;
  }
  return contour();
}

}  // namespace puck
