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
// As many events beside the ring as on it are worth half of what those are.
constexpr double kClutterWorth = -0.5;
// Events inside for each one on the ring, area for area: without a print there are far fewer.
constexpr double kPrint = 0.5;
// Events inside for each one on the ring: a print's two edges are shorter than the contour, and it
// has none where that has none. More are of something on the puck.
constexpr double kMostPrint = 2;

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

bool RingEvidence::shows_print(const RingAreas& areas) const {
  return is_print_inside(areas) && inside_ * areas.ring > kPrint * ring_ * areas.inside;
}

double RingEvidence::add_inside(const RingAreas& areas) {
  inside_ += 1;
  return is_print_inside(areas) ? 0 : kClutterWorth * areas.ring / areas.inside;
}

double RingEvidence::add_outside(const RingAreas& areas) {
  outside_ += 1;
  return kClutterWorth * areas.ring / areas.outside;
}

double RingEvidence::cover(const RingAreas& areas) const {
  double squares = 0;
  for (const double sector : sectors_) squares += sector * sector;
  return squares > 0 ? std::min(ring_ * ring_ / (areas.sectors * squares), 1.0) : 0;
}

bool RingEvidence::is_print_inside(const RingAreas& areas) const {
  return areas.may_have_print && inside_ <= kMostPrint * ring_ &&
         inside_ / areas.inside > outside_ / areas.outside;
}

double RingEvidence::clutter_density(const RingAreas& areas) const {
  const double around = outside_ / areas.outside;
  return is_print_inside(areas) ? around : (inside_ / areas.inside + around) / 2;
}

double RingEvidence::stands_out(const RingAreas& areas, double noise_per_px2, double doubt) const {
  // Where signs are judged half of the noise has the wrong one.
  const double wrong_noise = std::min(wrong_, noise_per_px2 * areas.ring / 2);
  const double good = std::max(0.0, (ring_ + wrong_noise) / areas.ring - noise_per_px2);
  const double bad = (wrong_ - wrong_noise) / areas.ring;
  const double clutter = std::max(0.0, clutter_density(areas) - noise_per_px2);
  return (good - bad - clutter) / (good + bad + clutter + doubt);
}

double RingEvidence::quality(const RingAreas& areas, double noise_per_px2) const {
  return stands_out(areas, noise_per_px2, kDoubt + noise_per_px2) *
         std::min(1.0, cover(areas) / kWholeCover);
}

double RingEvidence::agreement(const RingAreas& areas) const {
  return ring_ + wrong_ + inside_ + outside_ < kNothing ? 1 : stands_out(areas, 0, 0);
}

double RingEvidence::strength(const RingAreas& areas) const {
  return ring_ - wrong_ - areas.ring * clutter_density(areas);
}

}  // namespace puck
