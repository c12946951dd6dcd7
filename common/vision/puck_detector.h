#pragma once

#include <cstdint>
#include <optional>

#include "common/events/sensor_size.h"
#include "common/vision/correlation.h"
#include "common/vision/kernel_bank.h"
#include "common/vision/pixel.h"
#include "common/vision/puck_size_model.h"
#include "common/vision/region.h"

namespace puck {

enum class DetectionKernel : std::uint8_t {
  kSizeAtCentre,  ///< One kernel, of the size that the model gives at the region's centre (paper).
  kFixed,         ///< One kernel, whatever the region (the authors' code).
  kSizePerRow,    ///< The size that belongs to each row, so that a puck is found anywhere.
};

struct DetectorParams {
  DetectionKernel kernel = DetectionKernel::kSizeAtCentre;
  /// The paper's ROI_d; an empty region stands for the whole image.
  Region region{60, 150, 500, 80};
  /// What the kernel's response must exceed.
  double threshold = 3000;
  /// Height of the fixed kernel, px; its width is 1.6 times that.
  int fixed_height_px = 19;
  /// Ring, inside and outside of the fixed kernel.
  KernelProfile fixed_profile{0.6, 1.0, -1, 1, 0, KernelMeasure::kWeightedSum};
};

/// Finds the puck where nothing is known of it yet (paper, Section III-B, detection).
class PuckDetector {
 public:
  struct Detection {
    Pixel position;
    double response = 0;
  };

  PuckDetector(SensorSize sensor, const DetectorParams& params, const PuckSizeModel& size_model);

  /// ROI_d, inside the sensor.
  const Region& region() const { return region_; }

  /// How far a kernel of the detector's own reaches around its candidates, px; the bank's reach as
  /// far as their sizes.
  int reach() const { return fixed_kernel_.width() / 2 + 1; }

  /// The best place in `where` if its response exceeds the threshold. `bank` is the tracker's.
  std::optional<Detection> detect(Correlation& picture, const Region& where,
                                  const KernelBank& bank);

 private:
  Detection best_in(Correlation& picture, const EllipseKernel& kernel, const Region& where);
  Detection best_by_rows(Correlation& picture, const Region& where, const KernelBank& bank);

  DetectorParams params_;
  PuckSizeModel size_model_;
  Region region_;
  EllipseKernel fixed_kernel_;
  CorrelationMap map_;
};

}  // namespace puck
