#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "common/vision/make_pipeline.h"

namespace puck {

enum class Preset : std::uint8_t {
  kDefault,      ///< Contour filters on single events, and evidence that decides between them.
  kCorrelation,  ///< The paper's method with our improvements.
  kPaper,        ///< As the paper's text says.
  kReference,    ///< As the authors' code ran, without its errors.
};

/// Names of the presets, in the order of Preset.
inline constexpr std::array<std::string_view, 4> kPresetNames{"default", "correlation", "paper",
                                                              "reference"};
const char* to_string(Preset preset);
std::optional<Preset> preset_from(std::string_view name);

/// The others are in paper_presets.h.
HypothesesParams default_params();

PipelineParams preset_params(Preset preset);

}  // namespace puck
