#pragma once

#include "common/vision/eros_surface.h"
#include "common/vision/puck_pipeline.h"
#include "common/vision/tracking_algorithm.h"

namespace puck {

/// PUCK in one thread: the surface and the pipeline, one after the other. Live, the two run in a
/// thread each (runtime/).
class SurfaceTracker final : public TrackingAlgorithm {
 public:
  /// Throws std::invalid_argument, naming the key, when a parameter is out of range.
  SurfaceTracker(SensorSize sensor, const PipelineParams& params, const PuckSizeModel& size_model)
      : surface_(sensor, params.eros), pipeline_(sensor, params, size_model) {}

  void update(const EventPacket& packet) override { surface_.update(packet); }

  PuckEstimate estimate() override {
    surface_.snapshot(pipeline_.region_needed(), snapshot_);
    return pipeline_.step(snapshot_);
  }

 private:
  ErosSurface surface_;
  PuckPipeline pipeline_;
  SurfaceSnapshot snapshot_;
};

}  // namespace puck
