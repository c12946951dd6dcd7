#pragma once

#include "common/events/timestamp.h"

namespace puck {

struct EdgeTrailParams {
  /// Off: the trail is taken to be that of a dark puck.
  bool enabled = false;
  /// How widely the ring's grey is spread across the contour where pucks make many events a pixel,
  /// clutter included, px …
  double short_px = 0.85;
  /// … and how widely where they make hardly one.
  double long_px = 1.25;
  /// What the sensor's lag, which differs from event to event, adds to that, µs.
  double blur_us = 170;
  /// How long it takes to learn, ms of good track.
  double learning_ms = 200;
};

/// How long a trail the puck's contour draws on the surface, learned while the track is good. A
/// pixel fades with the events of its neighbours, so the contour of a puck of low contrast, which
/// makes hardly one event a pixel, stays on the surface several times as long as that of a dark
/// one, and the ring lies farther behind the puck.
class EdgeTrail {
 public:
  explicit EdgeTrail(const EdgeTrailParams& params) : params_(params) {}

  /// Takes how widely the ring's grey is spread, px, of a puck of that speed.
  void learn(double spread_px, double speed_px_s, Timestamp time);

  /// 0: as short as a dark puck's; 1: as long as that of one of low contrast.
  double length() const { return length_; }

 private:
  EdgeTrailParams params_;
  double length_ = 0;
  Timestamp learned_at_;
};

}  // namespace puck
