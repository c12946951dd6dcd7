#pragma once

#include <cstdint>

#include "common/events/sensor_size.h"
#include "common/vision/contour_track.h"
#include "common/vision/region.h"
#include "common/vision/unswept_place.h"

namespace puck {

/// A hand or a mallet that comes to a puck at rest, or stops it, leads the track away: its edges
/// make as many events as the puck's, at the wrong place. So the place where the puck rests, or was
/// last seen whole while slow, is watched. As long as the puck cannot have left it, it is there,
/// and a track that has gone bad elsewhere is brought back.
class LeftBehind {
 public:
  /// What is known of the main track.
  struct Situation {
    bool is_sure = false;     ///< It is followed, trusted and proven, and nothing is on it.
    bool is_resting = false;  ///< TrackStanding's.
    SensorSize sensor;
  };

  /// Takes an event; only those in region() count.
  void take(double x, double y) { place_.take(x, y); }

  /// To be called after each decision of the main track; true when it has been brought back to
  /// rest. Switched by ContourIngredients::left_behind.
  bool bring_back(ContourTrack& main, const Situation& now, const ContourContext& context,
                  std::int64_t time_us);

  /// Whether the puck does not rest undisturbed any more, but cannot have left its place.
  bool is_there() const { return is_there_; }
  /// Empty while no place is watched.
  Region region() const { return place_.region(); }

  /// The main track is another one.
  void forget();

 private:
  UnsweptPlace place_;
  bool is_there_ = false;
  std::int64_t stopped_us_ = 0;      // when the track last stood still
  std::int64_t undisturbed_us_ = 0;  // when it last rested, or was whole and slow
};

}  // namespace puck
