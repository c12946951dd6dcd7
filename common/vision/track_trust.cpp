#include "common/vision/track_trust.h"

#include <algorithm>

namespace puck {
namespace {

// So that trust that has grown for long is still lost within a second of bad looks.
constexpr std::int64_t kMostTrust_us = 1'000'000;
// What is half hidden may be sound for a while, and is covered all the same.
constexpr double kUncovered = 0.5;
// A weakly found track that moves as a puck does is the puck's after so long.
constexpr std::int64_t kBelievedAfter_us = 3'000;
// Of what is clear by its events, hardly anything but a puck looks so much like one to searches.
constexpr double kSeen = 0.55;
// A track that has moved by itself for so long has proved to be the puck's.
constexpr std::int64_t kProvenAfter_us = 30'000;

}  // namespace

void TrackTrust::judge(const TrackLooks& main, double seen_score, bool unseen, std::int64_t time_us,
                       std::int64_t passed_us) {
  const bool is_sound = main.quality > kSound || (main.is_clear() && seen_score > kSeen);
  if (is_sound) sound_us_ = time_us;
  unsound_us_ = is_sound ? 0 : unsound_us_ + (unseen ? 0 : passed_us);
  const bool is_whole = is_sound && main.cover > kUncovered;
  was_covered_ = !is_whole && (was_covered_ || main.is_covered());
  if (is_sound || !unseen) {
    trust_us_ =
        std::clamp<std::int64_t>(trust_us_ + (is_sound ? passed_us : -passed_us), 0, kMostTrust_us);
  }
  moving_us_ = is_sound && main.is_fast() ? moving_us_ + passed_us : 0;
  if (moving_us_ > kProvenAfter_us) is_proven_ = true;
  if (is_exhausted()) is_proven_ = false;
  const bool moves_clearly =
      main.is_clear() || (is_sound && main.is_strong() && main.moves_as_pucks_do());
  clear_us_ = moves_clearly ? clear_us_ + passed_us : 0;
  if (clear_us_ >= kBelievedAfter_us) was_weakly_found_ = false;
  if (main.is_good()) good_us_ = time_us;
}

void TrackTrust::note_found(bool weakly, std::int64_t time_us) {
  good_us_ = time_us;
  found_us_ = time_us;
  was_weakly_found_ = weakly;
  trust_us_ /= 2;
  moving_us_ = 0;
  clear_us_ = 0;
  is_proven_ = false;
  was_covered_ = false;
}

}  // namespace puck
