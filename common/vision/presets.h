#pragma once

#include <optional>
#include <string_view>

#include "common/vision/puck_pipeline.h"

namespace puck {

enum class Preset : std::uint8_t {
  kPaper,        ///< As the paper's text says.
  kReference,    ///< As the authors' code ran, without its errors.
  kCorrelation,  ///< The paper's method with our improvements.
  kDefault,      ///< The most accurate: a contour filter.
  kEvidence,     ///< To become the default: better on real recordings, but not yet in all games.
};

/// Name of a preset: `paper`, `reference`, `correlation`, `default`, `evidence`.
const char* to_string(Preset preset);
std::optional<Preset> preset_from(std::string_view name);

PipelineParams preset_params(Preset preset);

/// The authors' fits for 640×480 pixels, `static` with the camera at rest and `moving` with the
/// head in motion. Their annotations, boxes around all of the puck's events, are kAuthorsBoxScale
/// times the contour; these sizes are the contour's, as in every PuckSizeModel. The presets `paper`
/// and `reference` scale the sizes back, so that their kernels are the authors'.
inline constexpr double kAuthorsBoxScale = 1.29;
PuckSizeModel authors_static_size_model();
PuckSizeModel authors_moving_size_model();

}  // namespace puck
