#include "common/vision/presets.h"

#include <cmath>

#include <doctest/doctest.h>

#include "common/vision/paper/paper_presets.h"

namespace puck {

TEST_CASE("preset reference has the constants of the authors' code") {
  const PuckPipelineParams p = reference_params();
  CHECK(p.eros.half_width_px == 3);
  CHECK(p.eros.decay == doctest::Approx(0.7197).epsilon(1e-4));
  CHECK(p.eros.rounding == ErosRounding::kTruncateEachStep);
  CHECK(p.kernels.profile.inner_boundary == 0.4);
  CHECK(p.kernels.profile.outer_boundary == 0.8);
  CHECK(p.kernels.profile.inside_weight == -1.0);
  CHECK(p.kernels.profile.ring_weight == 3.0);
  CHECK(p.kernels.profile.outside_weight == -0.2);
  CHECK(p.kernels.profile.measure == KernelMeasure::kWeightedSum);
  CHECK(p.kernels.smallest_px == 9);
  CHECK(p.kernels.largest_px == 51);
  CHECK(p.kernels.margin_x_px == 4);
  CHECK(p.kernels.margin_y_px == 4);
  CHECK(p.kernels.whole_semi_axes);
  CHECK(p.detector.kernel == DetectionKernel::kFixed);
  CHECK(p.detector.region == Region{60, 150, 500, 80});
  CHECK(p.detector.threshold == 3000);
  CHECK(p.detector.fixed_height_px == 19);
  CHECK(p.detector.fixed_profile.inner_boundary == 0.6);
  CHECK(p.detector.fixed_profile.outer_boundary == 1.0);
  CHECK(p.detector.fixed_profile.inside_weight == -1);
  CHECK(p.detector.fixed_profile.ring_weight == 1);
  CHECK(p.detector.fixed_profile.outside_weight == 0);
  CHECK(p.tracker.first_region == Region{-15, -15, 49, 31});
  CHECK(p.tracker.region_factor == 3);
  CHECK(p.tracker.prior_sigma == 0.5);
  CHECK(p.kernels.size_scale == 1.29);
  CHECK(p.tracker.reach_margin_px == 2);
  CHECK_FALSE(p.tracker.centred_window);
  CHECK(p.tracker.shift_to_lowest);
  CHECK(p.tracker.quantised);
  CHECK_FALSE(p.loss.enabled);
  CHECK_FALSE(p.predicts);
  CHECK_FALSE(p.has_ring);
  CHECK_FALSE(p.leads);
  CHECK(p.motion.measurement_sigma_px == 0.7);
}

TEST_CASE("preset paper has the constants of the paper's text") {
  const PuckPipelineParams p = paper_params();
  CHECK(p.eros.half_width_px == 5);
  CHECK(p.eros.decay == doctest::Approx(std::pow(0.3, 1.0 / p.eros.half_width_px)));
  CHECK(p.eros.rounding == ErosRounding::kNearest);
  CHECK(p.kernels.profile.inner_boundary == 0.4);
  CHECK(p.kernels.profile.outer_boundary == 0.9);
  CHECK(p.kernels.profile.inside_weight == 0);
  CHECK(p.kernels.profile.ring_weight == 1);
  CHECK(p.kernels.profile.outside_weight == -0.2);
  CHECK(p.kernels.profile.measure == KernelMeasure::kWeightedSum);
  CHECK(p.kernels.smallest_px == 9);
  CHECK(p.kernels.largest_px == 51);
  CHECK(p.kernels.margin_x_px == 4);
  CHECK(p.kernels.margin_y_px == 0);
  CHECK_FALSE(p.kernels.whole_semi_axes);
  CHECK(p.detector.kernel == DetectionKernel::kSizeAtCentre);
  CHECK(p.detector.region == Region{60, 150, 500, 80});
  CHECK(p.detector.threshold == 5000);
  CHECK(p.tracker.first_region.empty());
  CHECK(p.tracker.region_factor == 1.5);
  CHECK(p.tracker.prior_sigma == 0.5);
  CHECK(p.kernels.size_scale == 1.29);
  CHECK(p.tracker.reach_margin_px == 2);
  CHECK(p.tracker.centred_window);
  CHECK(p.tracker.shift_to_lowest);
  CHECK_FALSE(p.tracker.quantised);
  CHECK_FALSE(p.loss.enabled);
  CHECK_FALSE(p.predicts);
  CHECK_FALSE(p.has_ring);
  CHECK_FALSE(p.leads);
  CHECK(p.motion.measurement_sigma_px == 0.7);
}

TEST_CASE("preset correlation has every improvement, paper and reference none of them") {
  for (const Preset preset : {Preset::kPaper, Preset::kReference, Preset::kCorrelation}) {
    const auto p = std::get<PuckPipelineParams>(preset_params(preset));
    const bool has = preset == Preset::kCorrelation;
    CHECK(p.has_ring == has);
    CHECK(p.leads == has);
    CHECK(p.predicts == has);
  }
}

TEST_CASE("the authors' size model gives the sizes of their code") {
  const KernelBank bank(reference_params().kernels);
  const auto size_at = [&](const PuckSizeModel& model, double y) {
    const PuckSize size = bank.nominal(model.at({320, y}));
    return std::pair{size.width, size.height};
  };
  CHECK(size_at(authors_static_size_model(), 0) == std::pair{19.0, 9.0});
  CHECK(size_at(authors_static_size_model(), 100) == std::pair{29.0, 17.0});
  CHECK(size_at(authors_static_size_model(), 190) == std::pair{37.0, 25.0});
  CHECK(size_at(authors_static_size_model(), 300) == std::pair{47.0, 35.0});
  // Beyond the bank, where the authors' code reads an empty kernel, the largest one is used.
  CHECK(size_at(authors_static_size_model(), 400) == std::pair{51.0, 45.0});
}

TEST_CASE("The paper's presets use Equation (2), the others the disc where there is one") {
  PuckSizeModel model = authors_static_size_model();
  model.disc = DiscModel{.width_0 = 10, .width_y = 0.1, .face_on_px = 60};
  const auto goes_by_disc = [&](const SearchParams& params) {
    return params.sizes_of(model).disc.has_value();
  };
  CHECK_FALSE(goes_by_disc(paper_params()));
  CHECK_FALSE(goes_by_disc(reference_params()));
  CHECK(goes_by_disc(correlation_params()));
  CHECK(goes_by_disc(default_params()));
}

TEST_CASE("presets are found by their names") {
  for (const Preset preset :
       {Preset::kPaper, Preset::kReference, Preset::kCorrelation, Preset::kDefault}) {
    CHECK(preset_from(to_string(preset)) == preset);
  }
  CHECK_FALSE(preset_from("best").has_value());
}

}  // namespace puck
