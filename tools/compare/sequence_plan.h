#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace puck {

/// A way to track: a preset of ours or a baseline.
struct Contestant {
  std::string name;
  std::vector<std::string> options;  ///< Of puck-evaluate.
  double cost = 0.15;                ///< About so much CPU time for each second of events.
};

/// The presets and the baselines, worst first.
std::vector<Contestant> contestants();
/// The preset `default` with one ingredient switched off.
Contestant default_without(const std::string& ingredient);

/// Sequences that differ in nothing but their seeds.
struct SequenceSet {
  std::string name;
  std::string title;
  std::string scene;     ///< File in the folder of scenes; empty: nothing changed.
  bool moving = false;   ///< The camera.
  int first_seed = 0;    ///< The others follow it.
  bool is_hard = false;  ///< One of the difficulties, each alone; shorter and fewer.
  bool shown = false;    ///< Its first sequence's trajectories are drawn.
  bool in_ablation = false;
  std::string published;  ///< What the paper reports of such sequences; empty: nothing.
};
/// Seeds 1 to 99 are for development: parameters are chosen and the size of the puck is calibrated
/// on them only. These sets are for testing: still from 1001, moving from 1101, the hard ones from
/// 1201, 1211, 1221 and so on.
std::vector<SequenceSet> sequence_sets();
/// Throws std::invalid_argument when there is none of that name.
SequenceSet set_of(const std::vector<SequenceSet>& sets, const std::string& name);

struct PlanOptions {
  /// More than so many hard ones would have each other's seeds.
  static constexpr int kMostSequences = 20;
  int sequences = 10;   ///< Of the still and of the moving set each, 1 to kMostSequences.
  double seconds = 30;  ///< Of each of these.
  /// Names of contestants: these alone, without the ablation; empty: all of them, and the ablation.
  std::vector<std::string> only;

  /// `ours` or `paper`: how puck-evaluate scores.
  std::string scoring = "ours";

  bool includes(const Contestant& contestant) const;
};
/// How many sequences of a set there are, and how long they are. The hard ones are half as many and
/// a third as long, from 2 to 10 s.
int sequences_of(const SequenceSet& set, const PlanOptions& options);
double seconds_of(const SequenceSet& set, const PlanOptions& options);

/// A recording to be made and all that is run on it.
struct Sequence {
  SequenceSet set;
  int seed = 0;
  double seconds = 0;
  bool shown = false;
  std::vector<Contestant> contestants;
};
/// The dearest first, so that none is left over at the end. On the hard sets the particle filter
/// does not run: it costs as much as all the others together.
std::vector<Sequence> plan_sequences(const PlanOptions& options,
                                     const std::vector<std::string>& ingredients);

/// A still one, seed 1, 10 s: the size of the puck and the lag of the sensor are calibrated on it,
/// and nothing is run.
Sequence calibration_sequence();
/// A still one, seed 2, on which everything runs in real time, for so long at most.
Sequence latency_sequence(const PlanOptions& options, double seconds);

/// About so much CPU time does it take to make a recording, to run one contestant on it, s.
double simulation_cost_s(const Sequence& sequence);
double evaluation_cost_s(const Sequence& sequence, const Contestant& contestant);
/// Of both together.
double cost_s(const Sequence& sequence);

}  // namespace puck
