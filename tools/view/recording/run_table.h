#pragma once

#include <cstdint>

#include "common/events/sensor_size.h"
#include "common/io/table_file.h"
#include "common/play/play_bridge.h"
#include "common/vision/interfaces/puck_estimate.h"
#include "tools/view/interface/view_scene.h"

namespace puck {

/// The game as puck-bridge would see it, from a tracker's estimates on a recording: the same
/// decisions, driven by sensor time. One thread.
class RunTable {
 public:
  RunTable(const TableCalibration& calibration, SensorSize sensor);

  /// Estimates in the order of their ticks.
  void take(const PuckEstimate& estimate, Timestamp tick);

  const ViewTable& table() const { return table_; }

 private:
  SensorSize sensor_;
  PlayBridge bridge_;
  std::int64_t estimates_ = 0;
  ViewTable table_;
};

}  // namespace puck
