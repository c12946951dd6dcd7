#include "services/tracker/tracker_params.h"

#include <cmath>
#include <string>
#include <string_view>
#include <variant>

#include "common/io/contour_calibration_file.h"
#include "common/io/evidence_file.h"
#include "common/io/pixel_mask_file.h"
#include "common/io/size_model_file.h"
#include "common/vision/paper/paper_presets.h"
#include "common/vision/presets.h"

namespace puck {
namespace {

void read_surface(Config& config, PipelineParams& pipeline) {
  SurfaceKind& surface = search_params(pipeline).surface;
  std::string name = to_string(surface);
  config.read_choice("tracker.surface", name, kSurfaceNames);
  surface = surface_kind_from(name).value();
  if (std::holds_alternative<HypothesesParams>(pipeline) && surface != SurfaceKind::kEros) {
    config.fail("tracker.surface",
                "of preset \"default\" must be \"eros\"; \"correlation\", \"paper\" and "
                "\"reference\" take the others");
  }
}

void read_detection_region(Config& config, Region& region) {
  std::array<double, 4> numbers{static_cast<double>(region.x), static_cast<double>(region.y),
                                static_cast<double>(region.width),
                                static_cast<double>(region.height)};
  config.read("tracker.detection_region", numbers, 0, SensorSize::kMax);
  for (const double number : numbers) {
    if (number != std::floor(number)) {
      config.fail("tracker.detection_region", "must be whole numbers of px");
    }
  }
  region = {static_cast<int>(numbers[0]), static_cast<int>(numbers[1]),
            static_cast<int>(numbers[2]), static_cast<int>(numbers[3])};
}

void read_milliseconds(Config& config, std::string_view key, std::int64_t& value_us) {
  std::int64_t milliseconds = value_us / 1000;
  config.read(key, milliseconds, 0, 10'000);
  value_us = milliseconds * 1000;
}

}  // namespace

TrackerServiceParams read_tracker_params(Config& config) {
  TrackerServiceParams params;
  std::string preset = "default";
  config.read_choice("tracker.preset", preset, kPresetNames);
  params.pipeline = preset_params(preset_from(preset).value());

  read_surface(config, params.pipeline);
  SearchParams& search = search_params(params.pipeline);
  config.read("tracker.half_width_px", search.eros.half_width_px, 1, 8);
  config.read("tracker.decay", search.eros.decay, 0.01, 0.999);
  read_detection_region(config, search.detector.region);
  config.read("tracker.detection_threshold", search.detector.threshold, 0, 1e9);

  // Preset default does not use these.
  PuckPipelineParams unused = correlation_params();
  auto* correlation = std::get_if<PuckPipelineParams>(&params.pipeline);
  PuckPipelineParams& paper = correlation != nullptr ? *correlation : unused;
  config.read("tracker.roi_only", paper.roi_only);
  config.read("tracker.region_factor", paper.tracker.region_factor, 1, 20);
  config.read("tracker.prior_sigma", paper.tracker.prior_sigma, 0.05, 10);
  config.read("tracker.lose", paper.loss.enabled);
  config.read("tracker.lowest_score", paper.loss.lowest_score, 0, 1);
  config.read("tracker.lowest_start_score", paper.loss.lowest_start_score, 0, 1);
  read_milliseconds(config, "tracker.coast_ms", paper.loss.coast_us);
  read_milliseconds(config, "tracker.search_period_ms", paper.loss.search_period_us);

  config.read("tracker.reproducible", params.reproducible);
  config.read("tracker.max_publish_hz", params.thread.max_publish_hz, 1, 100'000);

  std::string size_model;
  config.read("tracker.size_model", size_model);
  params.size_model =
      size_model.empty() ? authors_static_size_model() : read_size_model_file(size_model);
  params.has_own_size_model = !size_model.empty();
  if (params.has_own_size_model) {
    search.contour = read_contour_calibration(size_model).value_or(ContourCalibration{});
  }

  std::string evidence;
  config.read("tracker.evidence", evidence);
  if (!evidence.empty()) {
    auto* hypotheses = std::get_if<HypothesesParams>(&params.pipeline);
    if (hypotheses == nullptr) {
      config.fail("tracker.evidence", "must be \"\", except for preset \"default\"");
    }
    hypotheses->evidence = read_evidence_file(evidence);
  }

  std::string hot_pixel_mask;
  config.read("tracker.hot_pixel_mask", hot_pixel_mask);
  if (!hot_pixel_mask.empty()) params.hot_pixels = read_pixel_mask_file(hot_pixel_mask);
  return params;
}

}  // namespace puck
