#pragma once

#include <cstdint>
#include <optional>

#include "common/events/timestamp.h"
#include "common/table/puck_motion.h"
#include "common/table/puck_track.h"

namespace puck {

/// Finds mallet hits in the puck's track: its motion differs from gliding and bouncing since a
/// moment ago. One thread.
class HitFinder {
 public:
  explicit HitFinder(const PuckMotion& motion) : motion_(motion) {}

  /// Change of velocity by a hit since the last call; nothing without a hit. A puck that moves when
  /// it is first seen counts as hit from rest. Times must not go back, except after `forget`.
  std::optional<TableVelocity> see(Timestamp t, const PuckTrack& track);
  /// The next puck is a new one.
  void forget() { older_.reset(); }

 private:
  struct Seen {
    Timestamp t;
    PuckTrack track;
  };

  bool moves_by_a_hit(const PuckTrack& track) const;
  bool is_at_rail(const TablePoint& at) const;
  std::optional<TableVelocity> change_since(const PuckTrack& track, double elapsed_s) const;

  PuckMotion motion_;
  std::optional<Seen> older_;  // 60 to 120 ms ago, unless it was hit since
  Seen newer_;
};

}  // namespace puck
