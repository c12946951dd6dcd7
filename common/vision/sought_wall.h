#pragma once

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

  /// A track that is beyond doubt the puck's has, or has not, the other wall.
  void learn(bool is_other) { is_other_ = is_other; }

  /// For the next search: whether it is to look for the other wall. What was learned is doubted now
  /// and then when nothing is trusted any more, since the track may have been of something else.
  bool next(const Situation& now) {
    ++searches_;
    if (!is_other_) return !now.is_early && searches_ % 2 == 0;
    const bool is_doubted = !now.is_trusted && searches_ % kDoubts == 0;
    if (*is_other_) return !is_doubted;
    return is_doubted && now.may_be_faint;
  }

  /// Whether what a search for the other wall finds is a conjecture.
  bool is_conjecture() const { return !is_other_.value_or(false); }

 private:
  static constexpr unsigned kDoubts = 4;

  std::optional<bool> is_other_;  // nothing: never seen
  unsigned searches_ = 0;
};

}  // namespace puck
