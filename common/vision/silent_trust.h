#pragma once

#include <cstdint>

#include "common/vision/track_looks.h"

namespace puck {

/// Whether few events are no reason to doubt a track: what slows down makes hardly any, a faint
/// puck above all, and none while it is away. So it is as long as those that there are lie on the
/// ring of a puck, for 2 s after the track was last good. Asked with ingredient `silent-trust`
/// only.
inline bool is_silent_puck(const TrackLooks& looks, std::int64_t since_good_us) {
  constexpr double kAgreeing = 0.5;
  constexpr std::int64_t kRemembered_us = 2'000'000;
  return since_good_us < kRemembered_us && looks.agreement > kAgreeing && !looks.is_oversized();
}

}  // namespace puck
