#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/vision/challenger.h"
#include "common/vision/missed_events.h"
#include "common/vision/refuted_places.h"
#include "common/vision/takeover.h"
#include "common/vision/tracking_pipeline.h"

namespace puck {

/// All that may take the main track's place: so many of each kind at most, each for so long.
class Challengers {
 public:
  Challengers();

  /// Hands an event that was worth `main_worth` to the main track to each of them that is not blind
  /// to it.
  void take(const ContourEvent& event, double main_worth, const ContourContext& context) {
    for (Challenger& challenger : challengers_) {
      if (challenger.is_blind_to(event)) continue;
      challenger.take(event, main_worth, context);
    }
  }

  /// Adds one, unless there are enough of its kind; returns it.
  Challenger* add(Challenger::Kind kind, const ContourContext& context,
                  const ContourFilter::Start& start, std::int64_t time_us, double wall_share,
                  const Challenger::Found& found = {});

  /// What there is to know when a search has an answer.
  struct Answer {
    const SearchResult& result;
    bool is_conjecture = false;
    /// Where the main track was when the search's snapshot was taken; without, what was found there
    /// is tried as well.
    std::optional<Pixel> main;
    std::span<const MissedEvents::Missed> missed;  ///< Events since the search began.
    bool can_catch_up = true;                      ///< They are the events that there were.
    std::int64_t time_us = 0;                      ///< Now.
    std::int64_t period_us = 0;                    ///< Between two decisions.
    std::int64_t decided_us = 0;                   ///< Last decision.
  };

  /// Adds what a search found and is neither `main`, nor known, nor refuted of late: once
  /// for each opinion on the puck's side wall. What has left a steady trail is added wherever
  /// something was refuted, and starts as fast as that. What is known is noted to have been found
  /// again. Where there is no room, what no event speaks for gives way, and to what is evident the
  /// least likely.
  void add_found(const Answer& answer, const ContourContext& context);

  void decide(std::int64_t time_us, const ContourContext& context);

  /// The first that takes the main track's place.
  const Challenger* successor(const Defence& main, const ClaimContext& context,
                              std::int64_t time_us);
  /// Without a main track: the best that convinces, `searched_us` after the first search began.
  const Challenger* first(const ClaimContext& context, std::int64_t searched_us,
                          std::int64_t time_us);

  /// Gives up what the search found by mistake, and remembers where that was; but of what is fast
  /// while the head rests not, since an edge that passed has led it there.
  void dismiss_hopeless(std::int64_t time_us, bool head_rests);
  /// Gives up those that are too old, or have become the same as the main track.
  void dismiss_idle(const ContourFilter& main, std::int64_t time_us);
  void clear() { challengers_.clear(); }
  /// Gives up those that were born of the main track.
  void dismiss_born();

  /// Gives up all whose centres lie outside the image.
  void dismiss_outside(SensorSize sensor);

  std::vector<Challenger>::const_iterator begin() const { return challengers_.begin(); }
  std::vector<Challenger>::const_iterator end() const { return challengers_.end(); }

 private:
  bool note_known(Pixel position, const Challenger::Found& found, std::int64_t time_us);
  const Challenger* least_good(std::int64_t time_us) const;
  void make_room_for(const SearchCandidate& candidate, std::int64_t time_us);

  std::vector<Challenger> challengers_;
  RefutedPlaces refuted_;
};

}  // namespace puck
