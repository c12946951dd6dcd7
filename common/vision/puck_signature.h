#pragma once

#include <cmath>
#include <cstdint>

namespace puck {

/// What the puck's events look like, learned while the track is good: whether the puck is darker or
/// brighter than the table, how many events a pixel makes when its edge passes, how many there are
/// for each px² that the contour sweeps, and whether its face is plain.
class PuckSignature {
 public:
  /// An edge that moves faster than this along its normal passes a pixel quickly.
  static constexpr double kQuick_px_s = 200;

  /// What a good track gathered since the last call.
  struct Sample {
    double signed_speed = 0;    ///< Σ p·(n·v) of contour events, p = ±1.
    double absolute_speed = 0;  ///< Σ |n·v|.
    double events = 0;          ///< Contour events that were believed.
    double swept_px2 = 0;       ///< Area that the contour swept.
    double quick_events = 0;    ///< Contour events where the contour moves quickly …
    double first_events = 0;    ///< … that were the first of their sign at their pixel of late.
    double ring_per_px2 = 0;  ///< Contour events of its sign for each px² of the contour's band …
    double inside_per_px2 = 0;  ///< … and events well inside it for each px² there.

    /// Counts a contour event, believed or not. Where an edge passes slowly, its events are too far
    /// apart to be known as one passing.
    void count(bool on, double normal_speed, bool first) {
      signed_speed += on ? normal_speed : -normal_speed;
      absolute_speed += std::abs(normal_speed);
      if (std::abs(normal_speed) < kQuick_px_s) return;
      quick_events += 1;
      first_events += first ? 1 : 0;
    }
  };

  void learn(const Sample& sample, std::int64_t duration_us);
  /// What it was learned from has been the puck beyond doubt for so much longer.
  void confirm(std::int64_t duration_us);
  /// What was learned may be of something else: forgets it, but not that the puck is faint, if that
  /// has been confirmed for long enough.
  void forget();

  /// From −1, a puck darker than the table, to 1, a brighter one; 0 while it is not known.
  double contrast_sign() const;
  /// Whether the puck makes hardly more than one event at each pixel that its edge passes, as it
  /// does now, or, while that is not known, as has been confirmed.
  bool is_faint() const;
  /// Whether it may be faint: hands and clutter near the track make it seem to have more events.
  bool may_be_faint() const;
  bool knows_multiplicity() const { return sum_.first_events > kLeastEvents; }
  double multiplicity() const;
  /// When its multiplicity was last known, the puck was certainly not faint.
  bool had_contrast() const;
  /// The same, or, where that has been forgotten, as has been confirmed.
  bool remembers_contrast() const;
  /// Contour events per px² swept; nothing (0) while it is not known.
  double density() const;
  /// The same, or, after a rest, what it was when it was last known.
  double last_density() const { return last_density_; }
  /// So little has happened well inside the contour, for all that has happened on it, that there is
  /// no print. It is remembered however long the puck is slow, rests or is hidden.
  bool has_plain_face() const;

 private:
  bool was_faint() const;

  static constexpr double kLeastEvents = 30;
  Sample sum_;  // Fading with 0.5 s.
  double last_density_ = 0;
  double last_multiplicity_ = 0;
  // On average over the last two seconds for which it was confirmed, and for how long it was.
  double confirmed_multiplicity_ = 0;
  std::int64_t confirmed_us_ = 0;
  // Of the last 8 to 16 contour events a px² of the contour's band, however old.
  double ring_per_px2_ = 0;
  double inside_per_px2_ = 0;
};

}  // namespace puck
