#pragma once

#include "common/events/pixel_mask.h"
#include "common/io/config.h"
#include "common/runtime/tracking_thread.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/make_pipeline.h"

namespace puck {

struct TrackerServiceParams {
  PipelineParams pipeline;
  PuckSizeModel size_model;
  bool has_own_size_model = false;  ///< From tracker.size_model; else that of the paper's authors.
  PixelMask hot_pixels;
  TrackingThreadParams thread;
  bool reproducible = false;  ///< Key tracker.reproducible: SteppedTracker, one thread.
};

/// Reads the keys of [tracker]. The preset gives the defaults of all other keys. Throws
/// ConfigError.
TrackerServiceParams read_tracker_params(Config& config);

}  // namespace puck
