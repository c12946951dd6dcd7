#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/calibration/contour_ring.h"
#include "common/calibration/truth_motion.h"
#include "common/events/event_packet.h"

namespace puck {

/// An event near the contour of a puck whose true place and velocity are known.
struct ContourSample {
  double dx = 0;  ///< From the puck's true centre, px.
  double dy = 0;
  PixelVelocity velocity;
  ContourPlace place;
};

/// Gathers the events that tell where the contour of a moving puck fires. Those of times when
/// something else fires beside the puck are left out; with too many, they are thinned evenly.
class ContourSamples {
 public:
  ContourSamples(const TruthMotion& truth, const ContourPlaces& places);

  /// Packets in the order of their times.
  void add(const EventPacket& packet);
  /// After the last packet.
  void finish() { close_window(); }

  std::span<const ContourSample> samples() const { return samples_; }
  /// Stretches of 2 ms in which truth told the motion of a puck that was fast enough, and those of
  /// them in which its contour fired and nothing beside it did.
  std::int64_t windows() const { return windows_; }
  std::int64_t clear_windows() const { return clear_windows_; }

 private:
  void add(const Event& event, Timestamp time);
  void close_window();

  const TruthMotion& truth_;
  const ContourPlaces& places_;

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
