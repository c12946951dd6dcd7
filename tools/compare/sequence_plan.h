#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace puck {

/// A tracker under comparison: a preset, maybe on another surface, or a baseline.
struct Contestant {
  std::string name;
  std::vector<std::string> options;  ///< For puck-evaluate.
  double cost = 0.15;                ///< CPU time per second of events, approximate.
  bool only_by_name = false;         ///< Not run unless PlanOptions::only names it.
};

/// The presets and the baselines, worst first; before each preset that correlates, those of it on
/// the other surfaces, such as `correlation-tos`.
std::vector<Contestant> contestants();

/// Sequences that differ in their seeds only.
struct SequenceSet {
  std::string name;
  std::string title;
  std::string scene;      ///< File in the folder of scenes; empty: the plain scene.
  bool moving = false;    ///< A moving camera.
  int first_seed = 0;     ///< The other seeds follow it.
  bool is_hard = false;   ///< A scene with one difficulty; shorter and fewer sequences.
  bool shown = false;     ///< Trajectories of its first sequence are plotted.
  std::string published;  ///< The paper's figures for such sequences; empty: none.
};
/// Seeds 1 to 99 are for development: parameters and the puck's size come from them only. These
/// sets are for testing: still from 1001, moving from 1101, the hard ones from 1201, 1211, 1221 and
/// so on.
std::vector<SequenceSet> sequence_sets();
/// Throws std::invalid_argument for an unknown name.
SequenceSet set_of(const std::vector<SequenceSet>& sets, const std::string& name);

struct PlanOptions {
  /// With more, the seeds of the hard sets would overlap.
  static constexpr int kMostSequences = 20;
  int sequences = 10;   ///< Of each set that is not hard, 1 to kMostSequences.
  double seconds = 30;  ///< Length of each of these.
  /// Names of the only contestants; empty: all but those that run only by name.
  std::vector<std::string> only;

  /// `ours` or `paper`: puck-evaluate's --scoring.
  std::string scoring = "ours";

  /// Those of contestants() that run.
  std::vector<Contestant> included() const;
};
/// Number and length of a set's sequences. Hard sets have half as many, of a third of the length, 2
/// to 10 s.
int sequences_of(const SequenceSet& set, const PlanOptions& options);
double seconds_of(const SequenceSet& set, const PlanOptions& options);

/// A recording and its runs.
struct Sequence {
  SequenceSet set;
  int seed = 0;
  double seconds = 0;
  bool shown = false;
  std::vector<Contestant> contestants;
};
/// The longest first, for an even load of the cores. The particle filter skips the hard sets: it
/// costs as much as all other contestants together.
std::vector<Sequence> plan_sequences(const PlanOptions& options);

/// A still one, seed 1, 10 s, for calibrating the puck's size and the sensor's lag; without runs.
Sequence calibration_sequence();
/// A still one, seed 2, for the runs in real time, of at most `seconds`.
Sequence latency_sequence(const PlanOptions& options, double seconds);

/// Approximate CPU time of making a recording, and of one contestant's run on it, s.
double simulation_cost_s(const Sequence& sequence);
double evaluation_cost_s(const Sequence& sequence, const Contestant& contestant);
/// Sum of the recording and its runs.
double cost_s(const Sequence& sequence);

}  // namespace puck
