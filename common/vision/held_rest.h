#pragma once

#include <cstdint>

#include "common/vision/contour_track.h"
#include "common/vision/puck_signature.h"
#include "common/vision/track_looks.h"
#include "common/vision/track_standing.h"

namespace puck {

/// Whether what rests is surely the puck, and rests here: a faint puck is quiet while it moves,
/// too; a lost one may be gone.
bool may_hold(const TrackStanding& standing, const PuckSignature& signature);

/// A puck at rest stays where it is while a mallet or a hand comes near: what happens beside it
/// says nothing about it. It is let go when events lie all around its contour, since it sets off,
/// when they lie inside it, since something is on it, or when it has been disturbed for long.
class HeldRest {
 public:
  /// To be called after each decision of the main track, which it frees when it sets off. Switched
  /// by ContourIngredients::holding.
  void hold(ContourTrack& main, const TrackStanding& standing, const ContourContext& context,
            std::int64_t time_us);

  /// The main track has been brought back to rest although something happens beside it. Switched
  /// like hold().
  void seize(const ContourContext& context, std::int64_t time_us) {
    if (context.ingredients.holding) keep(time_us);
  }

  /// The judgement alone; `is_resting`: may_hold().
  void judge(const TrackLooks& main, bool is_resting, std::int64_t time_us);

  /// Whether the main track must not move, nor be led away.
  bool is_held() const { return is_held_; }
  /// Whether it was let go at the last decision because the puck sets off.
  bool sets_off() const { return sets_off_; }
  /// The main track is another one.
  void forget() { is_held_ = sets_off_ = false; }

 private:
  void keep(std::int64_t time_us) {
    is_held_ = true;
    quiet_us_ = time_us;
  }

  bool is_held_ = false;
  bool sets_off_ = false;
  std::int64_t quiet_us_ = 0;  // when it last rested undisturbed, or was seized
};

}  // namespace puck
