#pragma once

#include <cstdint>
#include <optional>

#include "common/vision/pixel.h"

namespace puck {

/// Where a puck that has left the image may have come back without having been fast: what is
/// farther from where it left must be as fast as that takes, and have so many events as a fast one
/// has.
class WayBack {
 public:
  struct Reach {
    Pixel from;
    double gone_s = 0;  ///< How long it has been gone.

    /// A puck that has not been fast may have come to `place`.
    bool contains(Pixel place) const { return may_lead_to(place, kNotFast_px_s); }

    /// A puck of this speed may have, even if it has been faster before.
    bool may_lead_to(Pixel place, double speed_px_s) const;
  };

  /// It is now beyond the image, here.
  void note_left(Pixel place, std::int64_t time_us) { left_ = Left{place, time_us}; }

  /// It is seen in the image, or something is believed to be it that is farther off.
  void forget() { left_.reset(); }

  /// None while it has not left.
  std::optional<Reach> reach(std::int64_t time_us) const;

 private:
  // What comes back faster has the events to do without.
  static constexpr double kNotFast_px_s = 650;

  struct Left {
    Pixel place;
    std::int64_t time_us = 0;
  };

  std::optional<Left> left_;
};

}  // namespace puck
