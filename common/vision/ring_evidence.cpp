#include "common/vision/ring_evidence.h"

#include <algorithm>

namespace puck {
namespace {

// Events per px² that count as nothing.
constexpr double kDoubt = 0.02;
// What is left of an event after twice the memory.
constexpr double kNothing = 0.13;
// A ring whose events cover this share of the directions is whole: one that moves along an axis
// has few events at its sides.
constexpr double kWholeCover = 0.35;

}  // namespace

void RingEvidence::fade(double keep) {
  ring_ *= keep;
  wrong_ *= keep;
  inside_ *= keep;
  outside_ *= keep;
  wall_inside_ *= keep;
  wall_outside_ *= keep;
  repeats_ *= keep;
  for (double& sector : sectors_) sector *= keep;
}

double RingEvidence::add_ring(int sector, bool saturates) {
  double& count = sectors_[static_cast<std::size_t>(sector)];
  const double share = 0.2 * ring_ + 0.5;
  const double worth = saturates ? std::min(1.0, 1.5 * share / (share + count)) : 1;
  count += 1;
  ring_ += 1;
  return worth;
}

double RingEvidence::cover() const {
  double squares = 0;
  for (const double sector : sectors_) squares += sector * sector;
  return squares > 0 ? ring_ * ring_ / (kContourSectors * squares) : 0;
}

double RingEvidence::stands_out(const RingAreas& areas, double noise_per_px2, double doubt) const {
  // Where signs are judged half of the noise has the wrong one.
  const double wrong_noise = std::min(wrong_, noise_per_px2 * areas.ring / 2);
  const double good = std::max(0.0, (ring_ + wrong_noise) / areas.ring - noise_per_px2);
  const double bad = (wrong_ - wrong_noise) / areas.ring;
  const double clutter = std::max(0.0, clutter_density(areas, inside_, outside_) - noise_per_px2);
  return (good - bad - clutter) / (good + bad + clutter + doubt);
}

double RingEvidence::quality(const RingAreas& areas, double noise_per_px2) const {
  return stands_out(areas, noise_per_px2, kDoubt + noise_per_px2) *
         std::min(1.0, cover() / kWholeCover);
}

double RingEvidence::agreement(const RingAreas& areas) const {
  return ring_ + wrong_ + inside_ + outside_ < kNothing ? 1 : stands_out(areas, 0, 0);
}

double RingEvidence::strength(const RingAreas& areas) const {
  return ring_ - wrong_ - areas.ring * clutter_density(areas, inside_, outside_);
}

}  // namespace puck
