#pragma once

#include <cstdint>

#include "common/vision/track_looks.h"

namespace puck {

/// How much the main track is trusted to be the puck's: the clocks that run while it is sound,
/// fast, or neither. All times are sensor time, µs.
class TrackTrust {
 public:
  /// A track of more than this quality is beyond doubt: it is sound; so is one that is clear and
  /// that searches see as a puck.
  static constexpr double kSound = 0.85;

  /// Notes how the main track looks at a decision, `passed_us` after the last one, and how it has
  /// looked to searches: SeenScore's. `unseen`: the puck rests, or makes hardly any events: what is
  /// known of it holds.
  void judge(const TrackLooks& main, double seen_score, bool unseen, std::int64_t time_us,
             std::int64_t passed_us);

  /// A search has just seen the puck where the main track is.
  void note_seen(std::int64_t time_us) { good_us_ = time_us; }
  /// The main track was replaced by one that passed a test against it.
  void note_takeover(std::int64_t time_us) { good_us_ = time_us; }
  /// … by one that a search found; `weakly`: far away and on little evidence.
  void note_found(bool weakly, std::int64_t time_us);

  /// It has been sound for long. Otherwise it may well be something else, and gives way to anything
  /// that looks better.
  bool is_trusted() const { return trust_us_ > kTrusted_us; }
  /// Nothing speaks for it any more: what was learned from it may be of something else.
  bool is_exhausted() const { return trust_us_ == 0; }
  /// It has moved as nothing but the puck does.
  bool is_proven() const { return is_proven_; }
  /// Trusted, proven, and nothing has been on it: it is the puck.
  bool is_surely_puck() const { return is_trusted() && is_proven() && !was_covered(); }
  /// Since it was found it has been seen to be a puck, so that it may rest.
  bool may_rest() const { return sound_us_ - found_us_ > kSoundFirst_us; }
  /// What was found on little evidence is not said to be the puck before it has looked like one
  /// beyond doubt for a while, or moved like one for a moment.
  bool is_believed() const {
    return !was_weakly_found_ || sound_us_ - found_us_ > kWeaklyFoundFor_us;
  }

  /// Something has been on it since it was last sound on most sides, or found: a hand may have
  /// taken it away.
  bool was_covered() const { return was_covered_; }

  std::int64_t since_good_us(std::int64_t time_us) const { return time_us - good_us_; }
  std::int64_t since_sound_us(std::int64_t time_us) const { return time_us - sound_us_; }
  /// The same, but for the time in which it was not to be seen.
  std::int64_t unsound_us() const { return unsound_us_; }

 private:
  static constexpr std::int64_t kTrusted_us = 200'000;
  static constexpr std::int64_t kSoundFirst_us = 20'000;
  static constexpr std::int64_t kWeaklyFoundFor_us = 20'000;

  std::int64_t good_us_ = 0;     // when it was last good, or seen
  std::int64_t sound_us_ = 0;    // when it was last sound
  std::int64_t unsound_us_ = 0;  // for how long it has been seen and not sound
  std::int64_t trust_us_ = 0;    // grows while it is sound, wanes while it is not
  std::int64_t moving_us_ = 0;   // for how long it has been sound and fast
  std::int64_t clear_us_ = 0;    // for how long it has moved as a puck does, beyond doubt
  bool is_proven_ = false;
  std::int64_t found_us_ = 0;  // when the search found it
  bool was_weakly_found_ = false;
  bool was_covered_ = false;
};

}  // namespace puck
