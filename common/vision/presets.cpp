#include "common/vision/presets.h"

#include <algorithm>

#include "common/vision/paper/paper_presets.h"

namespace puck {
const char* to_string(Preset preset) {
  return kPresetNames.at(static_cast<std::size_t>(preset)).data();
}

std::optional<Preset> preset_from(std::string_view name) {
  const auto* found = std::find(kPresetNames.begin(), kPresetNames.end(), name);
  if (found == kPresetNames.end()) return std::nullopt;
  return static_cast<Preset>(found - kPresetNames.begin());
}

HypothesesParams default_params() {
  HypothesesParams params{correlation_params(), {}};
  // Evidence decides on each candidate of the search, so that false candidates are acceptable.
  params.detector.threshold = 0.2;
  return params;
}

PipelineParams preset_params(Preset preset) {
  switch (preset) {
    case Preset::kPaper:
      return paper_params();
    case Preset::kReference:
      return reference_params();
    case Preset::kCorrelation:
      return correlation_params();
    case Preset::kDefault:
      break;
  }
  return default_params();
}

}  // namespace puck
