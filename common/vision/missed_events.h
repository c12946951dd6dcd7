#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "common/vision/contour_track.h"
#include "common/vision/region.h"

namespace puck {

/// The events since a search began, where it looks. What it finds was there when its snapshot was
/// taken, and catches up on them; live, a fast puck has got away from where it was found before the
/// answer comes. Asks for no memory once made.
class MissedEvents {
 public:
  struct Missed {
    ContourEvent event;
    double main_worth = 0;  ///< What it was worth to the main track.
  };

  MissedEvents() { events_.reserve(kMost); }

  /// A search begins; events in `where` matter to what it may find.
  void begin(const Region& where) {
    events_.clear();
    where_ = where;
  }
  /// What it found has caught up, or is not to: the main track is another one, to which these
  /// events have not been worth what they say.
  void end() { begin({}); }

  /// Takes an event after all others. Of too many it keeps the first: what has followed those is
  /// where it must be, nearly.
  void take(const ContourEvent& event, double main_worth) {
    if (has_room() && where_.contains(static_cast<int>(event.x), static_cast<int>(event.y))) {
      events_.push_back({event, main_worth});
    }
  }

  /// Since begin() and before end().
  bool are_kept() const { return !where_.empty(); }
  bool has_room() const { return events_.size() < kMost; }
  std::span<const Missed> events() const { return events_; }

 private:
  // A millisecond's work for as many as can be found at once.
  static constexpr std::size_t kMost = 8'192;

  std::vector<Missed> events_;
  Region where_;
};

}  // namespace puck
