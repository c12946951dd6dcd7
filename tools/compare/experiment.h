#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/compare/progress.h"
#include "tools/compare/result_store.h"
#include "tools/compare/sequence_plan.h"

namespace puck {

struct ExperimentSettings {
  std::filesystem::path programs;  ///< Folder of puck-simulate, puck-calibrate, puck-evaluate.
  std::filesystem::path scenes;
  std::filesystem::path output;
  int jobs = 2;
  bool keep_recordings = false;
};

/// One run of a contestant over a sequence.
struct Result {
  std::string set;
  int seed = 0;
  std::string contestant;
  /// figures.json, within.csv, score.csv; of a shown sequence ticks.csv as well.
  std::filesystem::path folder;
};
/// The kept figures of a deleted recording.
struct RecordingResult {
  std::string set;
  int seed = 0;
  double seconds = 0;
  bool shown = false;
  /// simulation.json with cpu_s; of a shown sequence truth.csv as well.
  std::filesystem::path folder;
};
struct ExperimentResults {
  std::vector<Result> results;  ///< In no particular order.
  std::vector<RecordingResult> recordings;
};

/// Makes recordings and runs trackers on them, each in a process of its own, several at a time. A
/// result with the same programs, scene, seed and options is reused. A recording is deleted after
/// its last run. Trackers get events and a calibration, never truth: the calibration is made from a
/// recording with a development seed.
class Experiment {
 public:
  explicit Experiment(ExperimentSettings settings);

  /// Runs everything. The runs of one sequence are made one after the other. Throws the
  /// std::runtime_error of a program that fails.
  ExperimentResults run(const std::vector<Sequence>& sequences);

 private:
  std::string program(const std::string& name) const;
  std::string recording_key(const Sequence& sequence) const;
  std::string evaluation_key(const Sequence& sequence,
                             const std::vector<std::string>& options) const;
  void calibrate();
  /// Makes the recording if it does not exist; returns its path without extension.
  std::filesystem::path record(const Sequence& sequence, Progress& progress);
  std::filesystem::path evaluate(const Sequence& sequence, const std::string& name,
                                 const std::vector<std::string>& options,
                                 const std::filesystem::path& recording);
  void run(const Sequence& sequence, Progress& progress, std::vector<Result>& results,
           std::vector<RecordingResult>& recordings);

  ExperimentSettings settings_;
  ResultStore recordings_;
  ResultStore results_;
  std::string simulate_hash_;
  std::string calibrate_hash_;
  std::string evaluate_hash_;
  std::filesystem::path size_model_;  ///< Empty until calibrated.
};

}  // namespace puck
