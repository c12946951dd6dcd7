#pragma once

#include <array>
#include <cstddef>

#include "common/events/timestamp.h"
#include "common/table/puck_track.h"

namespace puck {

/// Where the puck was in the last 50 ms or so, and how it moved there. A tracker that follows the
/// mallet which comes to hit, and finds the puck again when it has been hit, says that the puck
/// leapt; the trail tells whether it can have been a hit. One thread.
class PuckTrail {
 public:
  /// The puck as it is tracked at `t`. Times must not go back.
  void add(Timestamp t, const PuckState& state);
  void clear() { count_ = 0; }

  /// Whether a puck that went on from somewhere on the trail and was hit a few ms before `t` can
  /// move like this then: the way that it came meets the way that it went.
  bool leads_to(Timestamp t, const PuckState& state) const;

 private:
  struct Past {
    Timestamp t;
    PuckState state;
  };
  static constexpr std::size_t kPasts = 10;

  std::array<Past, kPasts> pasts_{};  // a ring
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace puck
