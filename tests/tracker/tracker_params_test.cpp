#include "services/tracker/tracker_params.h"

#include <string>
#include <variant>

#include <doctest/doctest.h>

#include "common/io/evidence_file.h"
#include "common/messaging/bus_settings.h"
#include "common/vision/paper/paper_presets.h"
#include "common/vision/presets.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"

namespace puck {

TEST_CASE("config/tracker.toml shows every key with its default") {
  const std::string file = source_folder() / "config/tracker.toml";
  Config config = Config::from_file(file);
  read_bus_params(config);
  // The size model's path is relative to the project's root, which a test may not run in.
  config.override_with("tracker.size_model=\"\"");
  const TrackerServiceParams shown = read_tracker_params(config);
  CHECK_NOTHROW(config.reject_unknown());

  Config empty;
  const TrackerServiceParams defaults = read_tracker_params(empty);
  Config only_keys = Config::from_file(file);
  CHECK(config.effective().find("tracker.max_publish_hz") != std::string::npos);
  for (const char* key :
       {"preset", "surface", "half_width_px", "decay", "detection_region", "detection_threshold",
        "region_factor", "prior_sigma", "lose", "lowest_score", "lowest_start_score", "coast_ms",
        "search_period_ms", "max_publish_hz", "size_model", "evidence", "hot_pixel_mask"}) {
    CAPTURE(std::string(key));
    CHECK(only_keys.has(std::string("tracker.") + key));
  }
  const SearchParams& search = search_params(shown.pipeline);
  CHECK(search.surface == default_params().surface);
  CHECK(search.eros.half_width_px == default_params().eros.half_width_px);
  CHECK(search.eros.decay == default_params().eros.decay);
  CHECK(search.detector.region.empty());
  CHECK(search.detector.threshold == default_params().detector.threshold);
  CHECK(shown.thread.max_publish_hz == defaults.thread.max_publish_hz);
  // The keys that preset default does not use.
  config.override_with("tracker.preset=correlation");
  const PuckPipelineParams paper =
      std::get<PuckPipelineParams>(read_tracker_params(config).pipeline);
  const PuckPipelineParams expected = correlation_params();
  CHECK(paper.tracker.region_factor == expected.tracker.region_factor);
  CHECK(paper.tracker.prior_sigma == expected.tracker.prior_sigma);
  CHECK(paper.loss.enabled == expected.loss.enabled);
  CHECK(paper.loss.lowest_score == expected.loss.lowest_score);
  CHECK(paper.loss.lowest_start_score == expected.loss.lowest_start_score);
  CHECK(paper.loss.coast_us == expected.loss.coast_us);
  CHECK(paper.loss.search_period_us == expected.loss.search_period_us);
}

TEST_CASE("a preset gives the defaults and keys override them") {
  Config config;
  config.override_with("tracker.preset=reference");
  config.override_with("tracker.half_width_px=5");
  config.override_with("tracker.detection_region=[10, 20, 30, 40]");
  const PuckPipelineParams params =
      std::get<PuckPipelineParams>(read_tracker_params(config).pipeline);
  CHECK(params.eros.half_width_px == 5);
  CHECK(params.eros.decay == reference_params().eros.decay);
  CHECK(params.detector.region == Region{10, 20, 30, 40});
  CHECK(params.detector.threshold == 3000);
  CHECK_FALSE(params.loss.enabled);
}

TEST_CASE("evidence is read from its file, by preset default only") {
  const TemporaryFolder folder;
  EvidenceParams evidence;
  evidence.place_puck += 1;
  write_evidence_file(folder / "evidence.toml", evidence, "made by hand");
  Config config;
  config.override_with("tracker.evidence=\"" + (folder / "evidence.toml").string() + "\"");
  const PipelineParams pipeline = read_tracker_params(config).pipeline;
  CHECK(std::get<HypothesesParams>(pipeline).evidence.place_puck == evidence.place_puck);
  config.override_with("tracker.preset=\"correlation\"");
  CHECK_THROWS_WITH_AS(read_tracker_params(config),
                       doctest::Contains("must be \"\", except for preset \"default\""),
                       ConfigError);
  config.override_with("tracker.preset=\"default\"");
  config.override_with("tracker.evidence=\"/nowhere.toml\"");
  CHECK_THROWS_WITH_AS(read_tracker_params(config), doctest::Contains("/nowhere.toml"),
                       ConfigError);
}

TEST_CASE("the presets that correlate take every surface, and default only EROS") {
  for (const std::string preset : {"default", "correlation", "paper", "reference"}) {
    for (const SurfaceKind surface :
         {SurfaceKind::kEros, SurfaceKind::kTos, SurfaceKind::kSits, SurfaceKind::kSae}) {
      CAPTURE(preset);
      CAPTURE(std::string(to_string(surface)));
      Config config;
      config.override_with("tracker.preset=" + preset);
      config.override_with(std::string("tracker.surface=") + to_string(surface));
      if (preset == "default" && surface != SurfaceKind::kEros) {
        CHECK_THROWS_AS(read_tracker_params(config), ConfigError);
      } else {
        CHECK(search_params(read_tracker_params(config).pipeline).surface == surface);
      }
    }
  }
}

TEST_CASE("impossible settings are refused with the key and the expected form") {
  const auto refusal = [](const char* assignment) -> std::string {
    Config config;
    config.override_with(assignment);
    try {
      read_tracker_params(config);
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  };
  CHECK(refusal("tracker.half_width_px=9").find("tracker.half_width_px") != std::string::npos);
  CHECK(refusal("tracker.preset=best").find("tracker.preset") != std::string::npos);
  CHECK(refusal("tracker.surface=scarf").find("\"eros\", \"tos\", \"sits\" or \"sae\"") !=
        std::string::npos);
  CHECK(refusal("tracker.surface=tos").find("of preset \"default\" must be \"eros\"") !=
        std::string::npos);
  CHECK(refusal("tracker.size_model=nowhere.toml").find("nowhere.toml") != std::string::npos);
  CHECK(refusal("tracker.detection_region=[1, 2]").find("tracker.detection_region") !=
        std::string::npos);
  CHECK(refusal("tracker.detection_region=[1, 2, 3.5, 4]").find("must be whole numbers") !=
        std::string::npos);
}

}  // namespace puck
