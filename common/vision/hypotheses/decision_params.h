#pragma once

#include <cstdint>

#include "common/vision/hypotheses/puck_belief.h"

namespace puck {

/// The numbers of the tracker's decisions that are neither learned nor physical.
struct DecisionParams {
  /// A packet of evidence is full with so many events beyond the sensor's noise, or after so long.
  double packet_events = 8;
  double packet_s = 0.010;
  /// Age from which a hypothesis may be merged, compared, counted as a mark and removed, µs.
  std::int64_t settled_us = 8'000;
  /// One that has been without events of its own for so long is removed, µs; one that has been the
  /// track may rest longer.
  std::int64_t silent_us = 20'000;
  std::int64_t resting_us = 3'000'000;
  BeliefRates rates;
  /// A packet says no more than so many nats.
  double most_nats = 4;
  /// The probability of a visible puck at its place at which a hypothesis becomes the track …
  double confirm = 0.95;
  /// … its share of the posterior of both at which it replaces the track …
  double replace = 0.8;
  /// … and the odds at which the track is given up.
  double lose_odds = 0.3;
  /// No search while the puck is this certainly seen where the track is.
  double sure = 0.995;
  /// Nats by which a manoeuvre just now is less likely than none, and how often one is tried.
  double manoeuvre_nats = 3;
  std::int64_t manoeuvre_us = 2'000;
  /// Standard deviation of the speed after a manoeuvre, px/s …
  double manoeuvre_px_s = 900;
  /// … and of what a search finds.
  double found_px_s = 600;
  /// How far from where the puck was last seen it is looked for, px, and the growth, px/s.
  double reach_px = 15;
  double reach_px_s = 2'000;
  /// Log odds that what a search finds is the puck: at score 0, and growth with the score.
  double found = -5;
  double found_per_score = 5;
  /// Odds that an object that looks like the puck is a mark of the scene: without known marks …
  double mark_odds = 0.003;
  /// … and the increase with each known mark.
  double mark_odds_each = 0.3;
  /// Odds that something new looks like the puck by chance, while the track makes no events, and
  /// the age at which they are down to 1/e: nothing looks like it for long. Chosen on the scenarios
  /// with a puck at rest in tests/vision, and on games with goals.
  double newcomer_odds = 0.02;
  double newcomer_s = 0.1;
  /// The camera turns if so many of 48 cells of the image show a scene that moves as one.
  int scene_cells = 24;
  /// A hypothesis as many standard errors from the scene's motion is as likely a mark as not.
  double still_sigma = 3;
  /// Rate at which a hypothesis slips from the puck to a mark, per second.
  double slip = 0.002;
  /// Where a lost puck may be that has hardly moved: distance from the place where it was last seen
  /// at which its density falls to 1/e, px, and the growth of that, px/s.
  double lost_px = 5;
  double lost_px_s = 100;
  /// Events farther from a contour than so many standard deviations, or than so many px if that is
  /// more, do not correct it.
  double gate_sigma = 3;
  double gate_px = 2;
  /// Published covariance: standard deviations of the sensor's lag, s, and of a resting puck's
  /// place, px.
  double lag_sigma_s = 50e-6;
  double place_sigma_px = 0.03;
};

}  // namespace puck
