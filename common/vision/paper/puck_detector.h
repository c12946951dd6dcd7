#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/vision/correlation/correlation.h"
#include "common/vision/correlation/kernel_bank.h"
#include "common/vision/geometry/image.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/geometry/region.h"

namespace puck {

enum class DetectionKernel : std::uint8_t {
  kSizeAtCentre,  ///< One kernel, of the model's size at the region's centre (paper).
  kFixed,         ///< One kernel for every region (the authors' code).
  kSizePerRow,    ///< The model's size at each row, so that a puck is found anywhere.
};

struct DetectorParams {
  DetectionKernel kernel = DetectionKernel::kSizeAtCentre;
  /// The paper's ROI_d; an empty region stands for the whole image.
  Region region{60, 150, 500, 80};
  /// Responses up to this do not count.
  double threshold = 3000;
  /// Height of the fixed kernel, px; its width is 1.6 times that.
  int fixed_height_px = 19;
  /// Ring, inside and outside of the fixed kernel.
  KernelProfile fixed_profile{0.6, 1.0, -1, 1, 0, KernelMeasure::kWeightedSum};
};

/// ROI_d, inside the sensor. Throws std::invalid_argument when it lies outside.
Region detection_region(SensorSize sensor, const DetectorParams& params);

/// Detects the puck without a prior position (paper, Section III-B, detection).
class PuckDetector {
 public:
  struct Detection {
    Pixel position;
    double response = 0;
  };

  /// Largest number of detections with the size of each row; otherwise there is at most one.
  static constexpr std::size_t kMostDetections = 48;

  /// Throws std::invalid_argument when the fixed kernel cannot be drawn.
  PuckDetector(const DetectorParams& params, const PuckSizeModel& size_model);

  /// Reach of the detector's own kernel around its candidates, px; for kernels of the bank see
  /// KernelBank::reach_beyond.
  int reach() const { return fixed_kernel_.width() / 2 + 1; }

  /// The best place in `where` and, with the size of each row, further peaks of the response, at
  /// least half a puck apart; best first, all above the threshold. `bank` is the tracker's. The
  /// result is valid until the next call.
  const std::vector<Detection>& detect(Correlation& picture, const Region& where,
                                       const KernelBank& bank);

 private:
  void find_best(Correlation& picture, const EllipseKernel& kernel, const Region& where);
  void find_peaks(Correlation& picture, const Region& where, const KernelBank& bank);
  void collect_peaks(const Region& where);
  void keep_best_apart();
  Detection refined(Correlation& picture, const Region& where, const KernelBank& bank,
                    Detection peak);

  DetectorParams params_;
  PuckSizeModel size_model_;
  EllipseKernel fixed_kernel_;
  CorrelationMap map_;
  Image<float> responses_;     // of the rows of a search
  std::vector<Region> parts_;  // of these rows, that are bright
  std::vector<Detection> peaks_;
  std::vector<Detection> found_;
};

}  // namespace puck
