#pragma once

#include <optional>
#include <string_view>

#include "common/vision/make_pipeline.h"

namespace puck {

enum class Preset : std::uint8_t {
  kPaper,        ///< As the paper's text says.
  kReference,    ///< As the authors' code ran, without its errors.
  kCorrelation,  ///< The paper's method with our improvements.
  kDefault,      ///< Contour filters on single events, and evidence that decides between them.
};

/// Name of a preset: `paper`, `reference`, `correlation`, `default`.
const char* to_string(Preset preset);
std::optional<Preset> preset_from(std::string_view name);

PipelineParams preset_params(Preset preset);

}  // namespace puck
