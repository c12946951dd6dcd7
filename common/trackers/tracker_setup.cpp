#include "common/trackers/tracker_setup.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "common/baselines/cluster_tracker.h"
#include "common/baselines/particle_filter.h"
#include "common/baselines/particle_filter_eros.h"
#include "common/io/config.h"
#include "common/io/parse_number.h"
#include "common/trackers/decision_numbers.h"
#include "common/vision/surface_tracker.h"

namespace puck {
namespace {

bool holds_size_model(const std::filesystem::path& path) {
  return std::filesystem::exists(path) && Config::from_file(path).has("size_model.width_0");
}

}  // namespace

const char* to_string(Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::kPuck:
      return "puck";
    case Algorithm::kCluster:
      return "cluster";
    case Algorithm::kParticleFilter:
      return "particle-filter";
    case Algorithm::kParticleFilterEros:
      return "particle-filter-eros";
  }
  return "unknown";
}

std::optional<Algorithm> algorithm_from(std::string_view name) {
  for (const Algorithm algorithm : kAlgorithms) {
    if (name == to_string(algorithm)) return algorithm;
  }
  return std::nullopt;
}

PipelineParams TrackerSetup::pipeline_params() const {
  PipelineParams params = preset_params(preset);
  SearchParams& search = search_params(params);
  if (detection_region) search.detector.region = *detection_region;
  search.surface = surface;
  search.contour = contour;
  search.search_delay_us = search_delay_us;
  const bool is_puck = algorithm == Algorithm::kPuck;
  auto* hypotheses = is_puck ? std::get_if<HypothesesParams>(&params) : nullptr;
  auto* correlation = is_puck ? std::get_if<PuckPipelineParams>(&params) : nullptr;
  if ((evidence || decision) && hypotheses == nullptr) {
    throw std::invalid_argument(std::string(evidence ? "--evidence" : "--scale-decision") +
                                " needs preset default, the only one that weighs evidence");
  }
  if (evidence) hypotheses->evidence = *evidence;
  if (decision) hypotheses->decision = *decision;
  if (surface != SurfaceKind::kEros && correlation == nullptr) {
    throw std::invalid_argument(
        "--surface needs preset correlation, paper or reference: the other trackers need eros");
  }
  if (roi_only && correlation == nullptr) {
    throw std::invalid_argument(
        "--roi-only needs algorithm puck with preset correlation, paper or reference: the others "
        "need every event");
  }
  if (roi_only) correlation->roi_only = true;
  if (search_delay_us > 0 && !is_puck) {
    throw std::invalid_argument("--search-delay needs algorithm puck: the others make no searches");
  }
  return params;
}

std::unique_ptr<TrackingAlgorithm> TrackerSetup::make(SensorSize sensor) const {
  switch (algorithm) {
    case Algorithm::kPuck:
      break;
    case Algorithm::kCluster:
      return std::make_unique<ClusterTracker>(sensor, puck_cluster_params(), size_model,
                                              pipeline_params());
    case Algorithm::kParticleFilter:
      return std::make_unique<ParticleFilter>(sensor, ParticleFilterParams{}, size_model,
                                              pipeline_params());
    case Algorithm::kParticleFilterEros:
      return std::make_unique<ParticleFilterEros>(sensor, ParticleFilterErosParams{}, size_model,
                                                  pipeline_params());
  }
  return std::make_unique<SurfaceTracker>(sensor, pipeline_params(), size_model);
}

Region parse_region(const std::string& text) {
  Region region;
  char rest = 0;
  // Five digits are enough for any sensor, and a sum of two such numbers cannot overflow.
  const int read = std::sscanf(text.c_str(), "%5d,%5d,%5d,%5d%c", &region.x, &region.y,
                               &region.width, &region.height, &rest);
  if (read != 4 || region.empty()) {
    throw std::invalid_argument("expected a region as x,y,w,h in px, such as 60,150,500,80, got " +
                                text);
  }
  return region;
}

std::optional<DecisionParams> scaled_decision(const std::vector<std::string>& scales) {
  if (scales.empty()) return std::nullopt;
  DecisionParams params;
  for (const std::string& scale : scales) {
    const std::size_t equals = std::min(scale.find('='), scale.size());
    const std::string name = scale.substr(0, equals);
    double factor = 0;
    const bool has_factor =
        equals < scale.size() && parse_number(scale.substr(equals + 1), factor) && factor > 0;
    const auto* number =
        std::find_if(kDecisionNumbers.begin(), kDecisionNumbers.end(),
                     [&](const DecisionNumber& each) { return name == each.name; });
    if (!has_factor || number == kDecisionNumbers.end()) {
      std::string names;
      for (const DecisionNumber& each : kDecisionNumbers) names += std::string(" ") + each.name;
      throw std::invalid_argument(
          "--scale-decision: expected NAME=FACTOR with a factor above 0, got " + scale +
          "; the names are" + names);
    }
    number->scale(params, factor);
  }
  return params;
}

std::filesystem::path find_calibration(const std::filesystem::path& recording,
                                       const std::filesystem::path& given) {
  if (!given.empty()) return given;
  std::filesystem::path beside = recording;
  beside.replace_extension(".toml");
  const std::filesystem::path fallback = "config/calibration/simulated_size.toml";
  if (holds_size_model(beside)) return beside;
  if (holds_size_model(fallback)) return fallback;
  throw std::runtime_error("no size model: neither " + beside.string() + " nor " +
                           fallback.string() + " holds one; name one with --size-model");
}

}  // namespace puck
