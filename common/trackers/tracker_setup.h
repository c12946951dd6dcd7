#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/vision/geometry/region.h"
#include "common/vision/interfaces/tracking_algorithm.h"
#include "common/vision/presets.h"

namespace puck {

enum class Algorithm : std::uint8_t { kPuck, kCluster, kParticleFilter, kParticleFilterEros };

inline constexpr std::array kAlgorithms{Algorithm::kPuck, Algorithm::kCluster,
                                        Algorithm::kParticleFilter, Algorithm::kParticleFilterEros};

/// `puck`, `cluster`, `particle-filter`, `particle-filter-eros`.
const char* to_string(Algorithm algorithm);
std::optional<Algorithm> algorithm_from(std::string_view name);

/// The tracker selected on the command line.
struct TrackerSetup {
  Algorithm algorithm = Algorithm::kPuck;
  Preset preset = Preset::kDefault;
  SurfaceKind surface = SurfaceKind::kEros;
  PuckSizeModel size_model;
  ContourCalibration contour;
  std::optional<EvidenceParams> evidence;  ///< Instead of what preset default has built in.
  std::optional<DecisionParams> decision;  ///< Instead of its built-in numbers.
  std::optional<Region> detection_region;  ///< Instead of the preset's.
  bool roi_only = false;                   ///< PuckPipelineParams::roi_only.
  std::int64_t search_delay_us = 0;        ///< SearchParams::search_delay_us.

  /// The preset's parameters with these changes. Throws std::invalid_argument for what the preset
  /// or the algorithm does not have.
  PipelineParams pipeline_params() const;
  std::unique_ptr<TrackingAlgorithm> make(SensorSize sensor) const;
};

/// Parses `x,y,w,h` in px. Throws std::invalid_argument with the expected format.
Region parse_region(const std::string& text);

/// DecisionParams with the numbers of each NAME=FACTOR multiplied; nothing for none. Throws
/// std::invalid_argument.
std::optional<DecisionParams> scaled_decision(const std::vector<std::string>& scales);

/// The size model's file for a recording: `given` if not empty, else BASE.toml beside the recording
/// if that has one, else config/calibration/simulated_size.toml below the working
/// folder. Throws std::runtime_error if there is none.
std::filesystem::path find_calibration(const std::filesystem::path& recording,
                                       const std::filesystem::path& given);

}  // namespace puck
