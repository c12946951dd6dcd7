#pragma once

#include <cstdint>
#include <limits>

#include "common/events/sensor_size.h"
#include "common/vision/contour_params.h"
#include "common/vision/region.h"
#include "common/vision/stirrings.h"
#include "common/vision/track_looks.h"

namespace puck {

/// Times and regions of the searches by correlation, one search at a time. Candidates are confirmed
/// by events, so a lost puck is hardly searched for while nothing moves.
class SearchPlan {
 public:
  /// State of the main track.
  struct Situation {
    TrackLooks main;
    bool is_lost = false;
    bool is_resting = false;
    bool is_trusted = false;
    bool is_proven = false;
    bool may_rest_elsewhere = false;  ///< The place of rest may be wrong.
    bool may_be_faint = false;        ///< PuckSignature's: it is seldom sound.
    std::int64_t since_good_us = 0;
    std::int64_t unsound_us = 0;  ///< TrackTrust's.
  };

  /// `detection_region`: searched before the first detection; empty: the whole image.
  SearchPlan(SensorSize sensor, const Region& detection_region);

  /// Takes an event, unless its pixel has fired recently.
  void take(int x, int y) { stirrings_.take(x, y); }

  /// Call at each decision while there is no main track: searches for the first.
  void plan_first(std::int64_t time_us);
  /// Call at each decision while there is one: searches everywhere now and then (switched by
  /// ContourIngredients::wide_search), and near a doubtful track often (`search`).
  void plan(const Situation& now, const ContourIngredients& ingredients, std::int64_t time_us);

  /// Starts the wanted search; empty: none. Until note_answer() no further one is wanted.
  Region give_out();
  void note_answer() { out_ = {}; }
  /// The region of the running or wanted search; empty: none.
  Region searched() const { return out_.united(wanted_); }

  /// Nothing moves among the taken events; the caller should then take events elsewhere, too.
  bool is_still(std::int64_t time_us) const { return stirrings_.is_still(time_us); }

  /// Sensor time since the first search was wanted.
  std::int64_t searched_us(std::int64_t time_us) const { return time_us - since_us_; }

  /// The puck's place is unknown: it has been lost for long, or the track has had a low score for
  /// long. The whole image is then searched, each 5 ms, and not the track's neighbourhood (switched
  /// by ContourIngredients::anywhere).
  static bool may_be_anywhere(const Situation& now);

  /// Period of the searches of the whole image otherwise. `is_still`: see is_still().
  static constexpr std::int64_t kNever_us = std::numeric_limits<std::int64_t>::max();
  static std::int64_t usual_period_us(const Situation& now, bool is_still);

 private:
  bool is_busy() const { return !searched().empty(); }
  bool is_pointless(std::int64_t time_us) const;
  void want(const Region& region, std::int64_t time_us);

  Region image_;
  Region detection_region_;
  Stirrings stirrings_;
  Region wanted_;  // now; empty: none
  Region out_;     // until its answer has come; empty: none
  std::int64_t since_us_ = -1;
  std::int64_t next_us_ = 0;                                               // first or near search
  std::int64_t wide_us_ = 0;                                               // last wide search
  std::int64_t wanted_us_ = std::numeric_limits<std::int64_t>::min() / 2;  // last of any
};

}  // namespace puck
