#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/calibration/truth_motion.h"
#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/vision/contour_calibration.h"
#include "common/vision/puck_contour.h"
#include "common/vision/puck_size_model.h"

namespace puck {

/// An event near the contour of a puck whose true place and velocity are known.
struct ContourSample {
  double dx = 0;  ///< From the puck's true centre, px.
  double dy = 0;
  Pixel centre;  ///< The true one.
  PixelVelocity velocity;
  /// Of the sign that the contour has there if the puck is brighter than the table.
  bool is_bright = false;
};

/// Gathers the events that tell where the contour of a moving puck fires. Those of times when
/// something else fires beside the puck are left out, and so are those of the other sign than most,
/// where there are so many that they are of a print on the puck; with too many, they are thinned
/// evenly.
class ContourSamples {
 public:
  /// The truth must outlive it. `lean_deg`: ContourCalibration's, which is not fitted.
  ContourSamples(const TruthMotion& truth, SensorSize sensor, const PuckSizeModel& size_model,
                 double lean_deg = 0);

  /// Packets in the order of their times.
  void add(const EventPacket& packet);
  /// After the last packet.
  void finish();

  std::span<const ContourSample> samples() const { return samples_; }
  double lean_deg() const { return lean_deg_; }
  /// The contour that the trackers would expect with this calibration, but for its lean, which is
  /// the one given.
  PuckContour contour(ContourCalibration calibration) const {
    calibration.lean_deg = lean_deg_;
    return {sensor_, size_model_, calibration, true};
  }
  /// Stretches of 2 ms in which truth told the motion of a puck that was fast enough, and those of
  /// them in which its contour fired and nothing beside it did.
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
