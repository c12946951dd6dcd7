#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "common/vision/hypotheses/evidence.h"

namespace puck {

/// A packet of evidence with what evidence_of needs, and whether it was of the puck.
struct LabelledPacket {
  EvidencePacket packet;
  EvidenceAreas areas;
  double density = 0;
  GameTraits game;
  bool is_puck = false;
};

/// The packets of one recording, which weigh as much as those of any other one of weight 1.
struct LabelledRecording {
  std::vector<LabelledPacket> packets;
  double weight = 1;
};

/// Fits all numbers of EvidenceParams: the likelihoods of each term by maximum
/// likelihood, with the outliers that the tracker allows for, then what a nat of each term is worth
/// by logistic regression, without a constant, so that a packet that says nothing is neutral. In a
/// recording each class weighs the same, and a packet as much as its events exceed the sensor's
/// noise. Throws std::invalid_argument when the packets of a class are too few.
EvidenceParams fit_evidence(std::span<const LabelledRecording> recordings);

/// How well the evidence of single packets tells the classes apart.
struct EvidenceQuality {
  std::size_t pucks = 0;
  std::size_t others = 0;
  /// Probability that a packet of the puck has more evidence than one of something else; none
  /// without both.
  std::optional<double> auc;
  /// Mean of −log of the probability of the right class, nats, where both classes are equally
  /// frequent: 0.69 if the evidence tells nothing.
  std::optional<double> log_loss;
};
EvidenceQuality quality_of(std::span<const LabelledPacket> packets, const EvidenceParams& params);

}  // namespace puck
