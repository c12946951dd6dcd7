#include "common/calibration/evidence_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "common/calibration/nelder_mead.h"
#include "common/calibration/refuse.h"
#include "common/vision/hypotheses/evidence_numbers.h"

namespace puck {
namespace {

using Number = double EvidenceParams::*;

struct WeighedPacket {
  const LabelledPacket* labelled = nullptr;
  double weight = 0;
};

double told_of(const LabelledPacket& labelled) {
  return evidence_of(labelled.packet, labelled.areas, labelled.density, labelled.game, {}).told;
}

// Evenly spread over a class, no more than the time for the fit allows.
std::vector<WeighedPacket> thinned(const LabelledRecording& recording, bool is_puck) {
  constexpr std::size_t kMost = 1'500;
  std::vector<WeighedPacket> all;
  for (const LabelledPacket& labelled : recording.packets) {
    if (labelled.is_puck != is_puck) continue;
    const double told = told_of(labelled);
    if (told > 0) all.push_back({&labelled, told});
  }
  const std::size_t count = std::min(all.size(), kMost);
  for (std::size_t i = 0; i < count; ++i) all[i] = all[i * all.size() / count];
  all.resize(count);
  double sum = 0;
  for (const WeighedPacket& packet : all) sum += packet.weight;
  for (WeighedPacket& packet : all) packet.weight *= recording.weight / sum;
  return all;
}

std::vector<WeighedPacket> packets_of(std::span<const LabelledRecording> recordings) {
  constexpr std::size_t kFewest = 50;
  std::vector<WeighedPacket> all;
  for (const bool is_puck : {true, false}) {
    const std::size_t before = all.size();
    for (const LabelledRecording& recording : recordings) {
      const std::vector<WeighedPacket> packets = thinned(recording, is_puck);
      all.insert(all.end(), packets.begin(), packets.end());
    }
    const std::span<WeighedPacket> of_class = std::span(all).subspan(before);
    if (of_class.size() < kFewest) {
      refuse("only " + std::to_string(of_class.size()) + " packets of events are " +
             (is_puck ? "of the puck" : "of anything else") + ", " + std::to_string(kFewest) +
             " or more are needed: give longer recordings");
    }
    // A class weighs the same although some recordings may not have it.
    double sum = 0;
    for (const WeighedPacket& packet : of_class) sum += packet.weight;
    for (WeighedPacket& packet : of_class) packet.weight /= 2 * sum;
  }
  return all;
}

// The numbers within their ranges as any real numbers: logits of their place in the range, on a
// scale of logarithms where that is positive.
class Coordinate {
 public:
  explicit Coordinate(Number value)
      : number_(*std::find_if(kEvidenceNumbers.begin(), kEvidenceNumbers.end(),
                              [&](const EvidenceNumber& n) { return n.value == value; })),
        is_ratio_(number_.lowest > 0) {}

  double from(const EvidenceParams& params) const {
    constexpr double kEdge = 1e-3;  // The range's ends are infinitely far.
    const double value = params.*number_.value;
    const double place =
        is_ratio_ ? std::log(value / number_.lowest) / std::log(number_.highest / number_.lowest)
                  : (value - number_.lowest) / (number_.highest - number_.lowest);
    const double inside = std::clamp(place, kEdge, 1 - kEdge);
    return std::log(inside / (1 - inside));
  }

  void set(EvidenceParams& params, double x) const {
    const double place = 1 / (1 + std::exp(-x));
    params.*number_.value = is_ratio_
                                ? number_.lowest * std::pow(number_.highest / number_.lowest, place)
                                : number_.lowest + place * (number_.highest - number_.lowest);
  }

 private:
  const EvidenceNumber& number_;
  bool is_ratio_;
};

// Changes these numbers so that the loss is least.
void fit(EvidenceParams& params, std::span<const Number> numbers,
         const std::function<double(const EvidenceParams&)>& loss) {
  constexpr double kStep = 0.25;
  std::vector<Coordinate> coordinates;
  std::vector<double> start;
  for (const Number number : numbers) {
    coordinates.emplace_back(number);
    start.push_back(coordinates.back().from(params));
  }
  const auto set = [&](std::span<const double> x) {
    for (std::size_t i = 0; i < x.size(); ++i) coordinates[i].set(params, x[i]);
  };
  set(nelder_mead(start, kStep, [&](std::span<const double> x) {
    set(x);
    return loss(params);
  }));
}

// By maximum likelihood.
template <typename LikelihoodsOf>
void fit_term(EvidenceParams& params, std::span<const Number> numbers,
              std::span<const WeighedPacket> packets, const LikelihoodsOf& likelihoods_of) {
  fit(params, numbers, [&](const EvidenceParams& tried) {
    double loss = 0;
    for (const WeighedPacket& packet : packets) {
      const ClassLikelihoods log = with_outliers(likelihoods_of(*packet.labelled, tried));
      loss -= packet.weight * (packet.labelled->is_puck ? log.puck : log.other);
    }
    return loss;
  });
}

// −log of the probability of the right class.
double loss_of(double nats, bool is_puck) { return std::log1p(std::exp(is_puck ? -nats : nats)); }

void fit_worths(EvidenceParams& params, std::span<const WeighedPacket> packets) {
  std::vector<Evidence> evidence;
  evidence.reserve(packets.size());
  for (const WeighedPacket& packet : packets) {
    const LabelledPacket& labelled = *packet.labelled;
    evidence.push_back(
        evidence_of(labelled.packet, labelled.areas, labelled.density, labelled.game, params));
  }
  constexpr std::array<Number, 3> kWorths{
      &EvidenceParams::place_worth, &EvidenceParams::sector_worth, &EvidenceParams::sign_worth};
  fit(params, kWorths, [&](const EvidenceParams& tried) {
    double loss = 0;
    for (std::size_t i = 0; i < packets.size(); ++i) {
      loss += packets[i].weight * loss_of(evidence[i].sum(tried), packets[i].labelled->is_puck);
    }
    return loss;
  });
}

// Share of pairs in which the one of `these` is above the one of `those`, which ascend; half of the
// equal ones.
double share_above(std::span<const double> these, std::span<const double> those) {
  double below = 0;
  for (const double nats : these) {
    const auto [from, to] = std::equal_range(those.begin(), those.end(), nats);
    below += 0.5 * static_cast<double>((from - those.begin()) + (to - those.begin()));
  }
  return below / (static_cast<double>(these.size()) * static_cast<double>(those.size()));
}

double mean_loss(std::span<const double> nats, bool is_puck) {
  double sum = 0;
  for (const double one : nats) sum += loss_of(one, is_puck);
  return sum / static_cast<double>(nats.size());
}

}  // namespace

EvidenceParams fit_evidence(std::span<const LabelledRecording> recordings) {
  const std::vector<WeighedPacket> packets = packets_of(recordings);
  // From numbers of a usual size. The likelihood hardly depends on a large concentration: a fit
  // that began there would stay there.
  EvidenceParams params{.place_puck = 5,
                        .place_puck_lift = 3,
                        .place_puck_outside = 0,
                        .place_other = 10,
                        .place_other_lift = 1,
                        .place_other_outside = 0.5,
                        .sector_puck = 100,
                        .sector_puck_even = 0.1,
                        .sector_other = 5,
                        .sector_other_even = 0.6,
                        .sign_puck = 0.03,
                        .sign_other = 0.3,
                        .place_worth = 1,
                        .sector_worth = 1,
                        .sign_worth = 1};
  constexpr std::array<Number, 6> kPlace{
      &EvidenceParams::place_puck,         &EvidenceParams::place_puck_lift,
      &EvidenceParams::place_puck_outside, &EvidenceParams::place_other,
      &EvidenceParams::place_other_lift,   &EvidenceParams::place_other_outside};
  constexpr std::array<Number, 4> kSector{
      &EvidenceParams::sector_puck, &EvidenceParams::sector_puck_even,
      &EvidenceParams::sector_other, &EvidenceParams::sector_other_even};
  constexpr std::array<Number, 2> kSign{&EvidenceParams::sign_puck, &EvidenceParams::sign_other};
  fit_term(params, kPlace, packets, [](const LabelledPacket& p, const EvidenceParams& tried) {
    return place_likelihoods(p.packet, p.areas, p.density, p.game, tried);
  });
  fit_term(params, kSector, packets, [](const LabelledPacket& p, const EvidenceParams& tried) {
    return sector_likelihoods(p.packet, p.game, tried);
  });
  fit_term(params, kSign, packets, [](const LabelledPacket& p, const EvidenceParams& tried) {
    return sign_likelihoods(p.packet, p.game, tried);
  });
  fit_worths(params, packets);
  return params;
}

EvidenceQuality quality_of(std::span<const LabelledPacket> packets, const EvidenceParams& params) {
  std::vector<double> pucks;
  std::vector<double> others;
  for (const LabelledPacket& p : packets) {
    const double nats = evidence_of(p.packet, p.areas, p.density, p.game, params).sum(params);
    (p.is_puck ? pucks : others).push_back(nats);
  }
  EvidenceQuality quality{.pucks = pucks.size(), .others = others.size()};
  if (pucks.empty() || others.empty()) return quality;
  std::sort(others.begin(), others.end());
  quality.auc = share_above(pucks, others);
  quality.log_loss = (mean_loss(pucks, true) + mean_loss(others, false)) / 2;
  return quality;
}

}  // namespace puck
