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
#include "common/vision/geometry/image.h"

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
  /// all in [now, now + slice). An empty packet starts at the slice's start; a packet with events
  /// keeps its start.
  void advance(EventPacket& packet);

  /// End of the last slice.
  Timestamp now() const;
  /// At `now()`.
  SimulatedTruth truth() const;

  /// Events that the sensor's readout dropped so far.
  std::int64_t events_lost() const;

  /// Sets the robot mallet's target: y on the robot's line, m. The mallet reaches it within a few
  /// ms. Clamped to the line; ignored for an autonomous robot and when not finite.
  void set_robot_mallet(double y_m);

  SensorSize sensor_size() const;
  /// Exact, for the camera in its home pose and the plane at half the puck's height, in which the
  /// puck's centre moves.
  Homography table_from_image() const;
  /// The exact pinhole model for a camera that turns about its centre.
  PinholeCamera camera() const;
  /// ln(intensity) on each pixel at `now()`; for pictures and tests.
  Image<float> log_intensity() const;

 private:
  class World;
  std::unique_ptr<World> world_;
};

}  // namespace puck
