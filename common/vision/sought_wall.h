#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

namespace puck {

/// Which opinion on the puck's side wall the search goes by. The contour of a puck whose wall makes
/// no events is lower by a third far away, so that the search hardly finds it while it looks for
/// one whose wall does. A track beyond doubt shows which it is. Until then the other wall than the
/// calibrated one is looked for in turn with it, but what is found is a conjecture: round marks on
/// the table have no wall either.
class SoughtWall {
 public:
  /// What there is to know when a search begins.
  struct Situation {
    bool is_early = false;      ///< Nothing has been found yet, and it has not been tried for long.
    bool is_trusted = false;    ///< TrackTrust's.
    bool may_be_faint = false;  ///< The puck, as far as its events tell.
  };

  /// A track that is beyond doubt the puck's has, or has not, the other wall, for `passed_us` more.
  /// What it had for longer of late counts: half out of the image no wall is to be seen.
  void learn(bool is_other, std::int64_t passed_us) {
    for_other_us_ = std::clamp(for_other_us_.value_or(0) + (is_other ? passed_us : -passed_us),
                               -kMemory_us, kMemory_us);
  }

  /// For the next search: whether it is to look for the other wall. What was learned is doubted now
  /// and then when nothing is trusted any more, since the track may have been of something else.
  bool next(const Situation& now) {
    ++searches_;
    if (!for_other_us_) return !now.is_early && searches_ % 2 == 0;
    const bool is_doubted = !now.is_trusted && searches_ % kDoubts == 0;
    if (*for_other_us_ > 0) return !is_doubted;
    return is_doubted && now.may_be_faint;
  }

  /// Whether what a search for the other wall finds is a conjecture.
  bool is_conjecture() const { return for_other_us_.value_or(0) <= 0; }

 private:
  static constexpr unsigned kDoubts = 4;
  static constexpr std::int64_t kMemory_us = 500'000;

  // For how long it has been the other wall, less: the calibrated one; nothing: never seen.
  std::optional<std::int64_t> for_other_us_;
  unsigned searches_ = 0;
};

}  // namespace puck
