#pragma once

#include <cstdint>
#include <optional>

#include "common/events/sensor_size.h"
#include "common/vision/puck_estimate.h"
#include "common/vision/track_looks.h"
#include "common/vision/track_trust.h"

namespace puck {

/// What is said of the main track: whether the puck is being followed, rests, has left the image or
/// is lost.
class TrackStanding {
 public:
  /// `coast_us`: how long a track without support is still believed.
  TrackStanding(SensorSize sensor, std::int64_t coast_us) : sensor_(sensor), coast_us_(coast_us) {}

  /// To be called at each decision while there is a main track. `witness_is_near`:
  /// WitnessCheck::is_near. `head_turns`: what rests makes events as well.
  void judge(const TrackLooks& main, bool witness_is_near, bool head_turns, const TrackTrust& trust,
             std::int64_t time_us);

  /// A search has just seen the puck where it is followed, or it cannot have left: it goes on to be
  /// there.
  void note_seen(std::int64_t time_us) { held_us_ = time_us; }

  TrackState state() const { return state_; }
  bool is_resting() const { return is_resting_; }
  /// It has rested for so long that what it rests on is no moment's mistake.
  bool has_settled(std::int64_t time_us) const { return time_us - moved_us_ > kSettling_us; }
  std::optional<Pixel> left_image() const { return left_image_; }

 private:
  static constexpr std::int64_t kSettling_us = 200'000;

  SensorSize sensor_;
  std::int64_t coast_us_;
  TrackState state_ = TrackState::kSearching;
  bool is_resting_ = false;
  std::optional<Pixel> left_image_;
  std::int64_t held_us_ = 0;   // when it was last good, seen or at rest
  std::int64_t whole_us_ = 0;  // when it was last so with its ring whole
  Pixel whole_at_;
  std::int64_t moved_us_ = 0;  // when it was last not at rest
};

}  // namespace puck
