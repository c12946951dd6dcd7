#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/calibration/truth_motion.h"
#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/vision/contour/contour_calibration.h"
#include "common/vision/contour/puck_contour.h"
#include "common/vision/geometry/puck_size_model.h"

namespace puck {

/// An event near the contour of a puck of known position and velocity.
struct ContourSample {
  double dx = 0;  ///< From the puck's true centre, px.
  double dy = 0;
  Pixel centre;  ///< The puck's true centre.
  PixelVelocity velocity;
  /// The event has the sign of a puck that is brighter than the table.
  bool is_bright = false;
};

/// Collects the events that show where the contour of a moving puck fires. Leaves out times when
/// other objects fire beside the puck, and the events of the minority sign where there are so many
/// that they come from a print on the puck. Too many events are thinned evenly.
class ContourSamples {
 public:
  /// `truth` must outlive this object. `lean_deg` as in ContourCalibration; it is not fitted.
  ContourSamples(const TruthMotion& truth, SensorSize sensor, const PuckSizeModel& size_model,
                 double lean_deg = 0);

  /// Packets in the order of their times.
  void add(const EventPacket& packet);
  /// Call after the last packet.
  void finish();

  std::span<const ContourSample> samples() const { return samples_; }
  double lean_deg() const { return lean_deg_; }
  /// The contour that the trackers would expect with this calibration, except its lean, which is
  /// the given one.
  PuckContour contour(ContourCalibration calibration) const {
    calibration.lean_deg = lean_deg_;
    return {sensor_, size_model_, calibration};
  }
  /// Windows of 2 ms in which truth gives the motion of a fast enough puck, and those of them in
  /// which the contour fired and its surroundings did not.
  std::int64_t windows() const { return windows_; }
  std::int64_t clear_windows() const { return clear_windows_; }

 private:
  void add(const Event& event, Timestamp time);
  void close_window();
  void leave_out_print();

  const TruthMotion& truth_;
  SensorSize sensor_;
  PuckSizeModel size_model_;
  double lean_deg_;
  PuckContour rough_;

  std::int64_t window_ = -1;
  bool has_motion_ = false;
  int ring_events_ = 0;
  int outside_events_ = 0;
  std::vector<ContourSample> pending_;

  std::vector<ContourSample> samples_;
  std::size_t keep_every_ = 1;
  std::size_t seen_ = 0;
  std::int64_t windows_ = 0;
  std::int64_t clear_windows_ = 0;
};

}  // namespace puck
