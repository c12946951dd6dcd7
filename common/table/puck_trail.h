#pragma once

#include <array>
#include <cstddef>

#include "common/events/timestamp.h"
#include "common/table/puck_track.h"

namespace puck {

/// The puck's path of about the last 50 ms. When a mallet hits the puck, a tracker may first follow
/// the mallet and then jump to the puck; the trail tests whether a hit explains the jump. One
/// thread.
class PuckTrail {
 public:
  /// Adds the tracked state at `t`. Times must not decrease.
  void add(Timestamp t, const PuckState& state);
  void clear() { count_ = 0; }

  /// Whether a hit a few ms before `t` explains this state: the path back from it meets a path on
  /// from a state of the trail.
  bool leads_to(Timestamp t, const PuckState& state) const;

 private:
  struct Sample {
    Timestamp t;
    PuckState state;
  };
  static constexpr std::size_t kSamples = 10;

  std::array<Sample, kSamples> samples_{};  // Ring buffer.
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace puck
