#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/vision/contour_track.h"
#include "common/vision/pixel.h"
#include "common/vision/puck_contour.h"

namespace puck {

/// Learns how high the puck's side wall is where the annotations leave it out: its lower edge makes
/// events below the face, always at the same share of the width, while clutter makes them anywhere.
/// Where it lies is measured from the face's upper edge and sides, so that a track that is too low,
/// or too large, because it takes the wall for another height does not mislead it. The same events
/// give the same answers, to the bit. One thread at a time.
class WallHeight {
 public:
  /// To be called at each decision. `puck`: the main track, beyond doubt the puck's, to which the
  /// events that follow are compared; none: they say nothing.
  void watch(const ContourTrack* puck, const PuckContour& contour, std::int64_t passed_us);

  /// Takes an event of near the main track.
  void take(const ContourEvent& event) {
    if (is_watching_) compare(event);
  }

  /// By what share of the width the wall's lower edge lies below the face's, in the image's middle,
  /// 0.08 to 0.49; nothing while no edge is clear.
  std::optional<double> share() const;

 private:
  // Events by share, in bins of so much from a little above the face's lower edge on.
  static constexpr std::size_t kBins = 64;
  static constexpr double kBin = 0.01;
  static constexpr double kFirst = -0.04;

  // How far outside the model's face one of its edges lies, on average, fading.
  class EdgeOffset {
   public:
    void add(double outward_px) {
      constexpr double kReach_px = 1.5;
      if (std::abs(outward_px) > kReach_px) return;
      events_ += 1;
      sum_px_ += outward_px;
    }
    void fade(double keep) {
      events_ *= keep;
      sum_px_ *= keep;
    }
    /// `unknown_px`: what it is while there are too few events.
    double mean_px(double unknown_px) const {
      constexpr double kEnough = 30;
      return events_ > kEnough ? sum_px_ / events_ : unknown_px;
    }

   private:
    double events_ = 0;
    double sum_px_ = 0;
  };

  void compare(const ContourEvent& event);
  static std::size_t bin_of(double share) {
    return static_cast<std::size_t>((share - kFirst) / kBin);
  }
  double count_around(std::size_t bin) const;

  bool is_watching_ = false;
  // The puck as of the last decision.
  ContourRing face_;
  double width_px_ = 0;
  double growth_px_ = 0;
  double profile_ = 1;  // PuckContour::wall_profile
  Pixel position_;
  PixelVelocity velocity_;
  PixelVelocity behind_px_;  // how far events lie behind upright and level edges
  std::int64_t time_us_ = 0;

  EdgeOffset upper_;
  EdgeOffset sides_;
  std::array<double, kBins> counts_{};  // fading
};

}  // namespace puck
