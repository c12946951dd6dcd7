#pragma once

#include <cstdint>

#include "common/vision/challengers.h"

namespace puck {

/// Challengers that are born of the main track, each kind now and then.
class Twins {
 public:
  /// One at rest where the main track is: a bounce or a hit may just have happened. Switched by
  /// ContourIngredients::twins.
  void bear_at_rest(const ContourTrack& main, const ContourContext& context, std::int64_t time_us,
                    Challengers& challengers);

  /// One of the other opinion on the puck's side wall: whether the wall makes events depends on its
  /// light. Switched by ContourIngredients::wall.
  void bear_of_other_wall(const ContourTrack& main, const ContourContext& context,
                          std::int64_t time_us, Challengers& challengers);

 private:
  std::int64_t at_rest_us_ = 0;  // when the last one was born
  std::int64_t of_other_wall_us_ = 0;
};

}  // namespace puck
