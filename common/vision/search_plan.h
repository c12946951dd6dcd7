#pragma once

#include <cstdint>
#include <limits>

#include "common/events/sensor_size.h"
#include "common/vision/contour_params.h"
#include "common/vision/region.h"
#include "common/vision/stirrings.h"
#include "common/vision/track_looks.h"

namespace puck {

/// When and where the correlation looks for the puck. One search at a time. What it finds must
/// prove itself on events, so that a puck that is lost is hardly searched for while nothing moves.
class SearchPlan {
 public:
  /// What there is to know of the main track.
  struct Situation {
    TrackLooks main;
    bool is_lost = false;
    bool is_resting = false;
    bool is_trusted = false;
    bool is_proven = false;
    bool may_rest_elsewhere = false;  ///< Where it is taken to rest may be wrong.
    bool may_be_faint = false;        ///< PuckSignature's: it is seldom sound.
    std::int64_t since_good_us = 0;
    std::int64_t unsound_us = 0;  ///< TrackTrust's.
  };

  /// `detection_region`: where the puck is looked for before it has been seen; empty: everywhere.
  SearchPlan(SensorSize sensor, const Region& detection_region);

  /// Takes an event, unless its pixel has fired of late.
  void take(int x, int y) { stirrings_.take(x, y); }

  /// To be called at each decision while there is no main track: searches for the first.
  void plan_first(std::int64_t time_us);
  /// To be called at each decision while there is one: searches everywhere now and then (switched
  /// by ContourIngredients::wide_search), and near a doubtful track often (`search`).
  void plan(const Situation& now, const ContourIngredients& ingredients, std::int64_t time_us);

  /// Hands the search out; empty: none is wanted now. None is until the answer has come.
  Region give_out();
  void note_answer() { out_ = {}; }
  /// What is searched, or is to be; empty: nothing.
  Region searched() const { return out_.united(wanted_); }

  /// Nothing moves where events were taken. What moves elsewhere should be taken as well then.
  bool is_still(std::int64_t time_us) const { return stirrings_.is_still(time_us); }

  /// Since the first search was wanted.
  std::int64_t searched_us(std::int64_t time_us) const { return time_us - since_us_; }

  /// Nobody knows where the puck is: it has been lost for long, or what is tracked has been seen
  /// for long without looking like it. Then it is searched for everywhere, each 5 ms, and not near
  /// the track (switched by ContourIngredients::anywhere).
  static bool may_be_anywhere(const Situation& now);

  /// How often the whole image is searched otherwise. `is_still`: nothing moves where events are
  /// taken.
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
