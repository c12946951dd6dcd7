#pragma once

#include <cstdint>
#include <optional>

#include "common/events/sensor_size.h"
#include "common/vision/contour/contour_calibration.h"
#include "common/vision/contour/soft_ring.h"
#include "common/vision/correlation/kernel_bank.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/paper/puck_detector.h"
#include "common/vision/surface/surface.h"

namespace puck {

/// Settings of the surface, and of the searches for the puck on it.
struct SearchParams {
  ErosParams eros;
  /// EROS has the settings above, the others have the defaults of SurfaceParams.
  SurfaceKind surface = SurfaceKind::kEros;
  SurfaceParams surface_params() const;
  KernelBankParams kernels;
  DetectorParams detector;
  /// A soft ring refines and scores what the kernels find; none in the paper.
  bool has_ring = false;
  ContourCalibration contour;
  /// The ring, if there is one.
  std::optional<SoftRing> make_ring(SensorSize sensor, const PuckSizeModel& size_model,
                                    bool other_wall = false) const;
  /// Puck sizes are those of a disc in perspective, where calibrated; otherwise, as in the paper,
  /// those of Equation (2).
  bool sizes_by_disc = false;
  /// The size model in use.
  PuckSizeModel sizes_of(PuckSizeModel model) const;
  /// Offline (SurfaceTracker): sensor time from a search's snapshot to its result, µs. Live, the
  /// result comes when the search is done.
  std::int64_t search_delay_us = 0;
};

}  // namespace puck
