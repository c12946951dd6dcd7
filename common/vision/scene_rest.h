#pragma once

#include <cstdint>
#include <optional>

#include "common/vision/background.h"
#include "common/vision/contour_track.h"

namespace puck {

/// Ingredient `scene-rests`. A faint puck that lies still beneath a turning head moves with the
/// scene, and is soon taken for a part of it, so that its events count no more; while the head
/// turns back there are hardly any; and a hand or a mallet that comes for it has many. It stays
/// where it lies in the scene all the same, until it is seen to move, or something else convinces
/// as the puck. Only a track that is not trusted yet is held, and while none of its events tells
/// whether the puck is faint, as before it first moves: later they tell better.
class SceneRest {
 public:
  /// To be called at each decision, after the main track's own: keeps in mind where in the scene a
  /// good track lies that moves with it, and brings it back there once it is good no more.
  void hold(ContourTrack& main, const Background& background, const ContourContext& context,
            std::int64_t time_us);

  /// The puck is taken to lie there, or to be just setting off.
  bool is_held() const { return lies_at_.has_value(); }

  /// To be called when another track becomes the main one, and while something else holds it.
  void forget() {
    lies_at_.reset();
    follows_since_us_.reset();
  }

 private:
  void watch(const ContourTrack& main, const Background& background, std::int64_t time_us);
  void carry(ContourTrack& main, const Background& background, const ContourContext& context,
             std::int64_t time_us);

  std::optional<Background::ScenePlace> lies_at_;
  std::optional<std::int64_t> follows_since_us_;  // since when it has moved with the scene
  std::int64_t seen_us_ = 0;                      // when it was last good there
};

}  // namespace puck
