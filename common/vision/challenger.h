#pragma once

#include <cstdint>
#include <span>

#include "common/vision/contour_track.h"
#include "common/vision/missed_events.h"
#include "common/vision/sighting_trail.h"

namespace puck {

/// A second belief that follows the same events as the main track and may take its place.
class Challenger {
 public:
  enum class Kind : std::uint8_t {
    kTwin,     ///< Where the main track is, at rest: a bounce or a hit may just have happened.
    kWitness,  ///< Where the blob is.
    kWall,     ///< Where the main track is, of the other opinion on the puck's side wall.
    kSearch,   ///< Where the correlation found something that looks like a puck.
  };

  /// What a search says of it.
  struct Found {
    double score = 0;            ///< SearchCandidate::score.
    bool is_conjecture = false;  ///< Only a search for a wall that the puck may not have found it.
    SightingTrail trail;         ///< As of the last search that found it.
  };

  Challenger(Kind kind, const ContourContext& context, const ContourFilter::Start& start,
             std::int64_t time_us, double wall_share, const Found& found)
      : kind_(kind),
        found_(found),
        has_other_wall_(context.contour.is_other_wall(wall_share)),
        born_us_(time_us),
        tried_since_us_(time_us),
        track_(context, start, time_us, wall_share) {}

  /// What the search found must prove itself without what stands still.
  bool is_blind_to(const ContourEvent& event) const {
    return event.still && kind_ == Kind::kSearch;
  }

  /// Takes an event that was worth `main_worth` to the main track.
  void take(const ContourEvent& event, double main_worth, const ContourContext& context) {
    const double worth = track_.take(event, context);
    const double lead = worth - main_worth;
    total_ += worth;
    total_variance_ += worth * worth;
    lead_ += lead;
    lead_variance_ += lead * lead;
  }

  void decide(std::int64_t time_us, const ContourContext& context) {
    track_.decide(time_us, false, context);
  }

  /// Takes what has happened since its birth, with decisions at multiples of `period_us` where
  /// there are events, the last one at `decided_us`. Takes as long as there are events.
  void catch_up(std::span<const MissedEvents::Missed> missed, std::int64_t period_us,
                std::int64_t decided_us, const ContourContext& context);

  /// The sequential test on the events since its birth: it explains them better than the main
  /// track, by more than chance, and well by itself.
  bool leads() const;

  /// Notes whether it convinces at this decision; since when it does without a break, µs, 0 if not.
  std::int64_t convincing_for_us(bool convinces, std::int64_t time_us);

  /// A later search found it again. What is more than a conjecture counts alone.
  void note_found(const Found& again);

  Kind kind() const { return kind_; }
  /// By the best that found it, with the highest score.
  const Found& found() const { return found_; }
  /// Whether it is of the other opinion on the puck's side wall than the calibration.
  bool has_other_wall() const { return has_other_wall_; }
  /// Of the events that it has taken.
  std::int64_t age_us(std::int64_t time_us) const { return time_us - born_us_; }
  /// For how long it has been tried: not before it had caught up.
  std::int64_t tried_us(std::int64_t time_us) const { return time_us - tried_since_us_; }
  const ContourTrack& track() const { return track_; }

 private:
  Kind kind_;
  Found found_;
  bool has_other_wall_;
  std::int64_t born_us_;
  std::int64_t tried_since_us_;
  std::int64_t convincing_since_us_ = -1;
  ContourTrack track_;
  double total_ = 0;
  double total_variance_ = 0;
  double lead_ = 0;
  double lead_variance_ = 0;
};

}  // namespace puck
