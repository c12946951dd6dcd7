#pragma once

#include <array>

#include "common/vision/contour/puck_contour.h"

namespace puck {

/// What the likelihoods of an EvidencePacket know about pucks and about everything else: the
/// numbers of config/calibration/evidence.toml, where the command stands that fitted them.
/// A concentration is the number of events after which a share that was seen outweighs the expected
/// one; a lift is a difference of log odds.
struct EvidenceParams {
  /// Place (ring, inside, outside): concentration, and by how much the shares of ring and outside
  /// exceed those of their areas, relative to the inside.
  double place_puck = 6.584;
  double place_puck_lift = 4.17;
  double place_puck_outside = 0.1549;
  double place_other = 9.662;
  double place_other_lift = 1.135;
  double place_other_outside = 0.4838;
  /// Sectors of the ring: concentration, and the share of the events that is spread evenly; the
  /// rest is proportional to the area that the contour sweeps there.
  double sector_puck = 99630;
  double sector_puck_even = 0.1101;
  double sector_other = 3.068;
  double sector_other_even = 0.7061;
  /// Sign of the contrast, dark or bright: concentration of each.
  double sign_puck = 0.01411;
  double sign_other = 0.1135;
  /// What a nat of each term is worth, as neither terms nor packets are independent.
  double place_worth = 1.102;
  double sector_worth = 0.6183;
  double sign_worth = 1.873;
};

struct EvidencePacket;

/// What is the same for a whole game: learned of the puck while it is beyond doubt, and of the
/// sensor.
class GameTraits {
 public:
  /// Sensor noise, events a px² and s.
  double noise_px2_s = 0;
  /// Log odds that the puck's side wall makes no events, so that its contour has the other height.
  double other_wall = 0;
  /// Number of marks seen that look like the puck. Never forgotten.
  double marks = 0;

  /// Takes a packet of a hypothesis that is the puck beyond doubt.
  void learn(const EvidencePacket& packet);
  /// Forgets a share of what was learned: the puck has not been seen for a while, and what was
  /// learned may be of something else.
  void forget(double share);
  /// Of the events of leading and trailing edges, those of leading ones: a pixel that has just
  /// fired, or whose threshold for the other sign is higher, makes fewer at the trailing edge.
  double leading_share() const { return (25 + leading_) / (50 + leading_ + trailing_); }
  /// Events of a pixel as the edge passes.
  double multiplicity() const { return (3 + events_ + repeats_) / (3 + events_); }

  /// Shares of the contour events that belong to a dark and to a bright puck. Both are near 0 until
  /// many events were seen, because the first ones may belong to a hand.
  double dark_share() const { return dark_ / (kTrusted_events + dark_ + bright_); }
  double bright_share() const { return bright_ / (kTrusted_events + dark_ + bright_); }
  bool knows_density() const { return events_ > 50; }
  /// Contour events a swept px².
  double density() const { return (3 + events_) / (3 + swept_px2_); }

 private:
  static constexpr double kTrusted_events = 1'000;

  double dark_ = 0;
  double bright_ = 0;
  double leading_ = 0;
  double trailing_ = 0;
  double events_ = 0;
  double repeats_ = 0;
  double swept_px2_ = 0;
};

/// Areas around a contour, px².
struct EvidenceAreas {
  double ring = 0;
  double inside = 0;
  double outside = 0;
  double reach_px = 0;  ///< Events farther outside are not counted.

  /// `seen`: share of the contour that lies in the image.
  static EvidenceAreas of(const ContourRing& ring, double seen);
  double all() const { return ring + inside + outside; }
};

/// The events near a hypothesis' contour since its last packet: a portion of evidence that is about
/// the same at any event rate.
struct EvidencePacket {
  /// Distance from the contour of a ring event, px, at most.
  static constexpr double kBand_px = 1.5;

  double ring = 0;
  double inside = 0;
  double outside = 0;
  std::array<double, kContourSectors> sectors{};  ///< Ring events.
  double dark = 0;          ///< Ring events of a contour darker than what it moves over …
  double bright = 0;        ///< … and brighter; only where it moves fast enough to tell.
  double leading = 0;       ///< Ring events where the contour moves outwards …
  double trailing = 0;      ///< … and inwards.
  double ring_repeats = 0;  ///< Ring events that follow the first of their pixel.
  double seconds = 0;
  /// Area swept by the contour by sector, px², including what the speed's error adds.
  std::array<double, kContourSectors> flux{};
  /// Area swept by the contour, px²: as estimated, and at one standard error of the speed less and
  /// more.
  double swept = 0;
  double swept_low = 0;
  double swept_high = 0;

  double near() const { return ring + inside + outside; }
};

/// Log likelihood ratios of a packet, puck against anything else, nats. Each is bounded, and 0 for
/// what the sensor makes by itself.
struct Evidence {
  double place = 0;
  double sector = 0;
  double sign = 0;
  /// Share of the events that the sensor's noise does not explain.
  double told = 0;

  double sum(const EvidenceParams& params) const {
    return params.place_worth * place + params.sector_worth * sector + params.sign_worth * sign;
  }
};

/// Log likelihoods of one term, nats, without what is the same for both classes.
struct ClassLikelihoods {
  double puck = 0;
  double other = 0;
};

/// `density`: contour events a swept px² to be expected.
ClassLikelihoods place_likelihoods(const EvidencePacket& packet, const EvidenceAreas& areas,
                                   double density, const GameTraits& game,
                                   const EvidenceParams& params);
ClassLikelihoods sector_likelihoods(const EvidencePacket& packet, const GameTraits& game,
                                    const EvidenceParams& params);
ClassLikelihoods sign_likelihoods(const EvidencePacket& packet, const GameTraits& game,
                                  const EvidenceParams& params);
/// Adds outliers to each class: packets that look like the other class', so that no single packet
/// decides. evidence_of compares these likelihoods.
ClassLikelihoods with_outliers(const ClassLikelihoods& likelihoods);

/// `density`: contour events a swept px² to be expected.
Evidence evidence_of(const EvidencePacket& packet, const EvidenceAreas& areas, double density,
                     const GameTraits& game, const EvidenceParams& params);

}  // namespace puck
