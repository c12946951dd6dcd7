#pragma once

#include <cstdint>

#include "common/events/sensor_size.h"
#include "common/vision/correlation/correlation.h"
#include "common/vision/correlation/kernel_bank.h"
#include "common/vision/geometry/image.h"
#include "common/vision/geometry/puck_size_model.h"

namespace puck {

/// How much each place of a surface looks like a puck of the size expected there: the kernels and
/// the measure of preset correlation, without a threshold. One thread.
class HeatMap {
 public:
  explicit HeatMap(const PuckSizeModel& size_model);

  /// `surface`: of the whole sensor. Fills `heat`, as large, with scores of 0 to 1 as 0 to 255.
  void fill(const Image<std::uint8_t>& surface, Image<std::uint8_t>& heat);

 private:
  PuckSizeModel size_model_;
  KernelBank kernels_;
  Correlation correlation_;
  CorrelationMap map_;
};

}  // namespace puck
