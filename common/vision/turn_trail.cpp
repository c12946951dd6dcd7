#include "common/vision/turn_trail.h"

namespace puck {

void TurnTrail::note(const CameraTurn& turn, std::int64_t time_us) {
  notes_[count_ % kNotes] = {turn, time_us};
  ++count_;
}

std::optional<PixelVelocity> TurnTrail::still_velocity_at(Pixel place) const {
  if (count_ < kNotes) return std::nullopt;
  const Note& newest = notes_[(count_ - 1) % kNotes];
  const Note& oldest = notes_[count_ % kNotes];
  const Pixel before = oldest.turn.now_of(newest.turn.then_of(place));
  const double per_s = 1e6 / static_cast<double>(newest.time_us - oldest.time_us);
  return PixelVelocity{(place.x - before.x) * per_s, (place.y - before.y) * per_s};
}

}  // namespace puck
