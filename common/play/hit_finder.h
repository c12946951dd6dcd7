#pragma once

#include <cstdint>
#include <optional>

#include "common/events/timestamp.h"
#include "common/table/puck_motion.h"
#include "common/table/puck_track.h"

namespace puck {

/// Finds the mallets' hits in the puck's track: the puck does not move as gliding and bouncing from
/// where it was a moment ago would have it move. One thread.
class HitFinder {
 public:
  explicit HitFinder(const PuckMotion& motion) : motion_(motion) {}

  /// By how much a hit since the puck was last seen has changed its velocity; nothing when there
  /// was none. A puck that is seen for the first time and moves counts as hit from rest. Times must
  /// not go back, except after `forget`.
  std::optional<TableVelocity> see(Timestamp t, const PuckTrack& track);
  /// The puck that is seen next is another one.
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
