#include "common/vision/hypotheses/evidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace puck {
namespace {

// Share of packets of either class that look like the other's, so that no single packet decides.
constexpr double kOutliers = 0.03;

// A product of Γ(a + k) / Γ(a), each of a whole k, with one logarithm for all small ones.
class RisingProduct {
 public:
  void multiply(double a, double k) {
    constexpr double kFew = 16;
    if (k > kFew) {
      int sign = 0;
      log_ += lgamma_r(a + k, &sign) - lgamma_r(a, &sign);
      return;
    }
    double product = 1;
    for (double i = 0; i < k; ++i) product *= a + i;
    constexpr double kLargest = 1e100;
    if (!(product < kLargest)) {
      log_ += std::log(product);
      return;
    }
    product_ *= product;
    if (product_ < kLargest && product_ > 1 / kLargest) return;
    log_ += std::log(product_);
    product_ = 1;
  }
  double log() const { return log_ + std::log(product_); }

 private:
  double product_ = 1;
  double log_ = 0;
};

// Of a Dirichlet-multinomial, without its coefficient, which is the same for both classes.
double log_likelihood(std::span<const double> counts, std::span<const double> shares,
                      double concentration) {
  double sum = 0;
  RisingProduct rising;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    sum += counts[i];
    rising.multiply(concentration * shares[i], counts[i]);
  }
  RisingProduct all;
  all.multiply(concentration, sum);
  return rising.log() - all.log();
}

// log(exp(a) + exp(b)).
double log_sum(double a, double b) {
  return std::max(a, b) + std::log1p(std::exp(-std::abs(a - b)));
}

// Likelihoods of both classes with outliers, divided by that of the other class without.
std::array<double, 2> over_other(double nats) {
  const double ratio = std::exp(std::clamp(nats, -30.0, 30.0));
  return {(1 - kOutliers) * ratio + kOutliers, 1 - kOutliers + kOutliers * ratio};
}

double bounded(const ClassLikelihoods& log) {
  const auto [puck, other] = over_other(log.puck - log.other);
  return std::log(puck / other);
}

// Events a px² that the sensor makes in a packet's time, and a few that come from anywhere.
double noise_px2(const EvidencePacket& packet, const GameTraits& game) {
  constexpr double kLeast_px2 = 1e-4;
  return game.noise_px2_s * packet.seconds + kLeast_px2;
}

using Sectors = std::array<double, kContourSectors>;

// Directions of the sectors, in the circle whose image the ellipse is; ContourRing::sector_of
// numbers them by quadrant.
const auto kDirections = [] {
  constexpr std::array<double, 3> kWithin_deg{15, 45, 75};
  std::array<std::array<double, 2>, kContourSectors> directions;
  for (std::size_t sector = 0; sector < kContourSectors; ++sector) {
    const double angle = kWithin_deg[sector % 3] * std::numbers::pi / 180;
    const std::size_t quarter = sector / 3;
    directions[sector] = {std::cos(angle) * ((quarter & 1) != 0 ? -1 : 1),
                          std::sin(angle) * ((quarter & 2) != 0 ? -1 : 1)};
  }
  return directions;
}();

// Area that an ellipse sweeps by sector, in any unit, when it moves in the direction of one of
// them.
Sectors flux_towards(std::size_t direction, double leading_share) {
  const auto [x, y] = kDirections[direction];
  Sectors flux;
  for (std::size_t sector = 0; sector < kContourSectors; ++sector) {
    const double outwards = kDirections[sector][0] * x + kDirections[sector][1] * y;
    flux[sector] = std::abs(outwards) * (outwards > 0 ? leading_share : 1 - leading_share);
  }
  return flux;
}

double log_of_sectors(const Sectors& counts, const Sectors& flux, double concentration,
                      double evenly) {
  double sum = 0;
  for (const double sector : flux) sum += sector;
  Sectors shares;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double share = sum > 0 ? flux[i] / sum : 1.0 / kContourSectors;
    shares[i] = (1 - evenly) * share + evenly / kContourSectors;
  }
  return log_likelihood(counts, shares, concentration);
}

}  // namespace

ClassLikelihoods place_likelihoods(const EvidencePacket& packet, const EvidenceAreas& areas,
                                   double density, const GameTraits& game,
                                   const EvidenceParams& params) {
  const std::array<double, 3> counts{packet.ring, packet.inside, packet.outside};
  const std::array<double, 3> even{areas.ring / areas.all(), areas.inside / areas.all(),
                                   areas.outside / areas.all()};
  const double made = noise_px2(packet, game) * areas.all();
  const auto log_of = [&](double own, double lift, double outside, double concentration) {
    std::array<double, 3> shares{even[0] * std::exp(lift), even[1], even[2] * std::exp(outside)};
    const double sum = shares[0] + shares[1] + shares[2];
    for (std::size_t i = 0; i < shares.size(); ++i) {
      shares[i] = (own * shares[i] / sum + made * even[i]) / (own + made);
    }
    return log_likelihood(counts, shares, concentration);
  };
  // Of a puck as many as suit its speed best, within the speed's error.
  const double expected =
      std::clamp(packet.ring, density * packet.swept_low, density * packet.swept_high);
  const double excess = std::max(packet.near() - made, 0.0);
  return {log_of(expected, params.place_puck_lift, params.place_puck_outside, params.place_puck),
          log_of(excess, params.place_other_lift, params.place_other_outside, params.place_other)};
}

ClassLikelihoods sector_likelihoods(const EvidencePacket& packet, const GameTraits& game,
                                    const EvidenceParams& params) {
  if (packet.ring < 2) return {};
  const auto puck = [&](const Sectors& flux) {
    return log_of_sectors(packet.sectors, flux, params.sector_puck, params.sector_puck_even);
  };
  // Where the speed's error exceeds the speed, a puck may move in any direction.
  const double squared = packet.swept * packet.swept;
  const double error = packet.swept_high - packet.swept;
  const double known = squared / (squared + error * error + 1e-9);
  constexpr double kWellKnown = 0.99;
  double log = puck(packet.flux);
  if (known < kWellKnown) {
    const double any = std::log((1 - known) / kContourSectors);
    log += std::log(std::max(known, 1e-9));
    for (std::size_t direction = 0; direction < kContourSectors; ++direction) {
      log = log_sum(log, any + puck(flux_towards(direction, game.leading_share())));
    }
  }
  return {log, log_of_sectors(packet.sectors, packet.flux, params.sector_other,
                              params.sector_other_even)};
}

ClassLikelihoods sign_likelihoods(const EvidencePacket& packet, const GameTraits& game,
                                  const EvidenceParams& params) {
  if (packet.dark + packet.bright == 0) return {};
  constexpr double kToneEvents = 2;
  const std::array<double, 2> counts{packet.dark, packet.bright};
  const double dark = params.sign_puck + kToneEvents * game.dark_share();
  const double bright = params.sign_puck + kToneEvents * game.bright_share();
  const std::array<double, 2> puck{dark / (dark + bright), bright / (dark + bright)};
  const std::array<double, 2> other{0.5, 0.5};
  return {log_likelihood(counts, puck, dark + bright),
          log_likelihood(counts, other, 2 * params.sign_other)};
}

ClassLikelihoods with_outliers(const ClassLikelihoods& likelihoods) {
  const auto [puck, other] = over_other(likelihoods.puck - likelihoods.other);
  return {likelihoods.other + std::log(puck), likelihoods.other + std::log(other)};
}

void GameTraits::learn(const EvidencePacket& packet) {
  constexpr double kMemory_packets = 500;
  constexpr double kKeep = 1 - 1 / kMemory_packets;
  dark_ = kKeep * dark_ + packet.dark;
  bright_ = kKeep * bright_ + packet.bright;
  events_ = kKeep * events_ + packet.ring;
  leading_ = kKeep * leading_ + packet.leading;
  trailing_ = kKeep * trailing_ + packet.trailing;
  repeats_ = kKeep * repeats_ + packet.ring_repeats;
  swept_px2_ = kKeep * swept_px2_ + packet.swept;
}

void GameTraits::forget(double share) {
  for (double* value :
       {&dark_, &bright_, &leading_, &trailing_, &events_, &repeats_, &swept_px2_, &other_wall}) {
    *value *= 1 - share;
  }
}

EvidenceAreas EvidenceAreas::of(const ContourRing& ring, double seen) {
  constexpr double kBand = EvidencePacket::kBand_px;
  const double reach = std::clamp(0.6 * ring.half_width(), 3.5, 7.0);
  return {seen * (ring.reach_area(kBand) - ring.inside_area(kBand)), seen * ring.inside_area(kBand),
          seen * ring.outside_area(kBand, reach), reach};
}

Evidence evidence_of(const EvidencePacket& packet, const EvidenceAreas& areas, double density,
                     const GameTraits& game, const EvidenceParams& params) {
  Evidence evidence;
  if (packet.near() == 0) return evidence;
  const double made = noise_px2(packet, game) * areas.all();
  evidence.told = std::max(packet.near() - made - 2 * std::sqrt(made), 0.0) / packet.near();
  double place = bounded(place_likelihoods(packet, areas, density, game, params));
  // No more on the ring than beside it, by area, never speaks for a ring.
  if (packet.ring * areas.all() < packet.near() * areas.ring) place = std::min(place, 0.0);
  evidence.place = evidence.told * place;
  evidence.sector = evidence.told * bounded(sector_likelihoods(packet, game, params));
  evidence.sign = evidence.told * bounded(sign_likelihoods(packet, game, params));
  return evidence;
}

}  // namespace puck
