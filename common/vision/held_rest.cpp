#include "common/vision/held_rest.h"

namespace puck {
namespace {

constexpr std::int64_t kLongestDisturbance_us = 100'000;
// A puck that sets off makes events on both sides; a mallet beside it on one.
constexpr double kDepartingStrength = 12;
constexpr double kDepartingCover = 0.25;
constexpr double kCovered = 12;

}  // namespace

void HeldRest::judge(const TrackLooks& main, bool is_resting, std::int64_t time_us) {
  departs_ = false;
  if (is_resting) {
    is_held_ = true;
    quiet_us_ = time_us;
    return;
  }
  if (!is_held_) return;
  departs_ = (main.strength > kDepartingStrength && main.cover > kDepartingCover) ||
             main.inside_events > kCovered;
  if (departs_ || time_us - quiet_us_ > kLongestDisturbance_us) is_held_ = false;
}

}  // namespace puck
