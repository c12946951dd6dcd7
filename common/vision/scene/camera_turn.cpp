#include "common/vision/scene/camera_turn.h"

#include <cstddef>

namespace puck {

// Rodrigues' rotation, which stays one however often it is applied.
void CameraTurn::turn(const Steps& steps) {
  // About the axes right, down and forward.
  const std::array<double, 3> angles{-steps[1] / focal_px_, steps[0] / focal_px_,
                                     steps[2] / focal_px_};
  const double angle =
      std::sqrt(angles[0] * angles[0] + angles[1] * angles[1] + angles[2] * angles[2]);
  if (!(angle > 0)) return;
  const double s = std::sin(angle) / angle;
  const double c = (1 - std::cos(angle)) / (angle * angle);
  const auto [a, b, d] = angles;
  const std::array<double, 9> more{
      1 - c * (b * b + d * d), c * a * b - s * d,       c * a * d + s * b,
      c * a * b + s * d,       1 - c * (a * a + d * d), c * b * d - s * a,
      c * a * d - s * b,       c * b * d + s * a,       1 - c * (a * a + b * b)};
  std::array<double, 9> turned{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      for (std::size_t k = 0; k < 3; ++k) {
        turned[3 * row + column] += more[3 * row + k] * turn_[3 * k + column];
      }
    }
  }
  turn_ = turned;
}

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
