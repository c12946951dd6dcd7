#pragma once

#include <cstdint>

#include "common/vision/puck_belief.h"

namespace puck {

/// The numbers of the tracker's decisions that are neither learned nor physical.
struct DecisionParams {
  /// A packet of evidence is full with so many events beyond the sensor's noise, or after so long.
  double packet_events = 8;
  double packet_s = 0.010;
  BeliefRates rates;
  /// A packet says no more than so many nats.
  double most_nats = 4;
  /// The posterior at which a hypothesis becomes the track …
  double confirm = 0.99;
  /// … its share of the posterior of both at which it replaces the track …
  double replace = 0.8;
  /// … and the odds at which the track is given up.
  double lose_odds = 0.3;
  /// No search while the puck is this certainly seen where the track is.
  double sure = 0.99;
  /// Nats by which a manoeuvre just now is less likely than none, and how often one is tried.
  double manoeuvre_nats = 3;
  std::int64_t manoeuvre_us = 2'000;
  /// Standard deviation of the speed after a manoeuvre, px/s …
  double manoeuvre_px_s = 900;
  /// … and of what a search finds.
  double found_px_s = 600;
  /// Log odds that what a search finds is the puck: at score 0, and growth with the score.
  double found = -5;
  double found_per_score = 5;
  /// Nats against what moves with the scene of a turning camera.
  double own_motion_nats = 7;
};

}  // namespace puck
