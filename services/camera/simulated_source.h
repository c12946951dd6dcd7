#pragma once

#include <functional>

#include "common/simulation/simulated_table.h"
#include "services/camera/event_source.h"

namespace puck {

/// The simulated table.
class SimulatedSource final : public EventSource {
 public:
  /// State of the world at the end of the previous chunk; called at that time.
  using OnTruth = std::function<void(const SimulatedTruth&)>;

  /// `truth_period_us`: sensor time between two truths; at least a slice of the world. Throws
  /// std::invalid_argument for invalid parameters.
  SimulatedSource(const SimulationParams& params, std::int64_t truth_period_us, OnTruth on_truth);

  Outcome next(Chunk& chunk) override;
  std::optional<SensorSize> sensor_size() const override { return table_.sensor_size(); }
  /// Events lost in the simulated sensor's readout.
  std::int64_t events_dropped() const override { return table_.events_lost(); }

  /// y on the robot's line, m. Valid until the next call.
  void set_robot_mallet(double y_m) { table_.set_robot_mallet(y_m); }

 private:
  SimulatedTable table_;
  std::int64_t truth_period_us_;
  OnTruth on_truth_;
  Timestamp next_truth_;
};

}  // namespace puck
