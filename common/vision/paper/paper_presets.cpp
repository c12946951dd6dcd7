#include "common/vision/paper/paper_presets.h"

#include <cmath>

namespace puck {
namespace {

PuckSizeModel contour_of_box(const PuckSizeModel& box) {
  return {.width_0 = box.width_0 / kAuthorsBoxScale,
          .width_x = box.width_x / kAuthorsBoxScale,
          .width_y = box.width_y / kAuthorsBoxScale,
          .height_0 = box.height_0 / kAuthorsBoxScale,
          .height_x = box.height_x / kAuthorsBoxScale,
          .height_y = box.height_y / kAuthorsBoxScale};
}

}  // namespace

// As in the paper's text: decay d = 0.3^(1/k); a kernel that is 1 on the ring, 0 inside and
// slightly negative outside; a detection kernel of the regression's size at the centre of ROI_d; a
// tracking region slightly larger than the puck; a Gaussian of half the kernel's size.
PuckPipelineParams paper_params() {
  PuckPipelineParams params;
  params.eros = {5, std::pow(0.3, 1.0 / 5), ErosRounding::kNearest};
  params.kernels.profile = {0.4, 0.9, 0, 1, -0.2, KernelMeasure::kWeightedSum};
  params.kernels.margin_x_px = 4;
  params.kernels.margin_y_px = 0;
  params.kernels.whole_semi_axes = false;
  params.detector.kernel = DetectionKernel::kSizeAtCentre;
  // The text gives no number. The authors' code once had 5000; its later 3000 is less than this
  // kernel, which is not negative inside the ring, responds to noise.
  params.detector.threshold = 5000;
  params.tracker.region_factor = 1.5;
  params.kernels.size_scale = kAuthorsBoxScale;
  params.tracker.centred_window = true;
  params.loss.enabled = false;
  return params;
}

// The authors' code at the time of the paper, without two errors: the centre pixel set in the wrong
// place at the left and top border, and an empty kernel for sizes beyond the bank.
PuckPipelineParams reference_params() {
  PuckPipelineParams params;
  params.eros = {3, std::pow(0.1, 1.0 / 7), ErosRounding::kTruncateEachStep};
  params.kernels.profile = {0.4, 0.8, -1, 3, -0.2, KernelMeasure::kWeightedSum};
  params.detector.kernel = DetectionKernel::kFixed;
  params.tracker.first_region = {-15, -15, 49, 31};
  params.kernels.size_scale = kAuthorsBoxScale;
  params.tracker.quantised = true;
  params.loss.enabled = false;
  return params;
}

PuckPipelineParams correlation_params() {
  PuckPipelineParams params;
  // The decay of a window half as wide: on real contours longer edges score better.
  params.eros = {5, 0.8963, ErosRounding::kNearest};
  params.kernels.profile = {0.7, 1.25, -0.5, 1, -0.5, KernelMeasure::kContrast};
  params.kernels.largest_px = 81;
  params.kernels.margin_x_px = 10;
  params.kernels.margin_y_px = 10;
  params.kernels.whole_semi_axes = false;
  params.sizes_by_disc = true;
  params.detector.kernel = DetectionKernel::kSizePerRow;
  params.detector.region = {};
  // Low: the soft ring tests each detection.
  params.detector.threshold = 0.35;
  params.tracker.centred_window = true;
  params.tracker.shift_to_lowest = false;
  // Small, because the prediction centres it.
  params.tracker.region_factor = 2;
  params.has_ring = true;
  params.motion.measurement_sigma_px = 0.2;
  params.loss.lowest_score = 0.55;
  params.loss.lowest_start_score = 0.6;
  params.loss.search_period_us = 3'000;
  params.predicts = true;
  params.leads = true;
  return params;
}

PuckSizeModel authors_static_size_model() {
  return contour_of_box({17.715624038044254, 0.0035291125887034315, 0.09579542600737656,
                         6.313115087846054, 0.0022264258939534796, 0.09551609558936817});
}

}  // namespace puck
