#pragma once

#include <cstdint>

#include "common/vision/challengers.h"

namespace puck {

/// Challengers that are born of the main track, each kind now and then.
class Twins {
 public:
  /// Takes what an event said for the main track: ContourTrack::take's.
  void take(double main_worth) {
    if (main_worth == 0) return;
    ++events_;
    worth_ += main_worth;
  }

  /// One at rest where the main track is: a bounce or a hit may just have happened. Not while a
  /// main track beyond doubt explains what there is, since each costs as much as the track itself.
  /// To be called at each decision at which one may be born. Switched by ContourIngredients::twins.
  void bear_at_rest(const ContourTrack& main, const ContourContext& context, std::int64_t time_us,
                    Challengers& challengers);

  /// One of the other opinion on the puck's side wall: whether the wall makes events depends on its
  /// light. Switched by ContourIngredients::wall.
  void bear_of_other_wall(const ContourTrack& main, const ContourContext& context,
                          std::int64_t time_us, Challengers& challengers);

 private:
  bool is_needless(const ContourTrack& main, const ContourContext& context) const;
  void fade(std::int64_t time_us);

  // Of the main track's last events, fading.
  double events_ = 0;
  double worth_ = 0;
  std::int64_t faded_us_ = 0;
  std::int64_t at_rest_us_ = 0;  // when the last one was born
  std::int64_t of_other_wall_us_ = 0;
};

}  // namespace puck
