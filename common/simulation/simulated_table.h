#pragma once

#include <cstdint>
#include <memory>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"
#include "common/simulation/simulated_truth.h"
#include "common/simulation/simulation_params.h"
#include "common/table/homography.h"
#include "common/table/table_camera.h"
#include "common/vision/image.h"

namespace puck {

/// An air-hockey table with a puck, an opponent and a robot's mallet, seen by an event camera.
/// Deterministic: the same parameters and the same calls give the same events. One thread at a
/// time.
class SimulatedTable {
 public:
  /// Throws std::invalid_argument as `check(params)` does.
  explicit SimulatedTable(const SimulationParams& params);
  ~SimulatedTable();
  SimulatedTable(SimulatedTable&&) noexcept;
  SimulatedTable& operator=(SimulatedTable&&) noexcept;

  /// Advances the world by one slice and appends the slice's events in the order of their times,
  /// all in [now, now + slice). An empty packet starts at the slice's start; one that holds events
  /// already keeps its start.
  void advance(EventPacket& packet);

  /// End of the last slice.
  Timestamp now() const;
  /// At `now()`.
  SimulatedTruth truth() const;

  /// Events so far that the sensor's readout could not take.
  std::int64_t events_lost() const;

  /// Where the arm holds the robot's mallet: y on the robot's line. The mallet glides there within
  /// a few ms. Clamped to the line; ignored for an autonomous robot and when not finite.
  void set_robot_mallet(double y_m);

  SensorSize sensor_size() const;
  /// For the camera in its home pose, of the plane at half the puck's height, where its centre
  /// moves. Exact.
  Homography table_from_image() const;
  /// What follows the table when the camera turns, which it does about its own place. Exact.
  PinholeCamera camera() const;
  /// ln(intensity) that falls on each pixel at `now()`; for pictures and tests.
  Image<float> log_intensity() const;

 private:
  class World;
  std::unique_ptr<World> world_;
};

}  // namespace puck
