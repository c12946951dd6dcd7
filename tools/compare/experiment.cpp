#include "tools/compare/experiment.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "common/runtime/parallel.h"
#include "tools/compare/content_hash.h"
#include "tools/compare/program.h"
#include "tools/compare/text_table.h"

namespace puck {
namespace {

using Json = nlohmann::ordered_json;

std::string sequence_name(const Sequence& sequence) {
  std::ostringstream name;
  name << sequence.set.name << '-' << sequence.seed << '-' << sequence.seconds << "s";
  return name.str();
}

std::string result_name(const Sequence& sequence, const std::string& contestant) {
  std::string name = sequence_name(sequence) + "-" + contestant;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += " " + word;
  return line;
}

// A run's figures for its progress line.
std::string told(const Sequence& sequence, const std::string& contestant,
                 const std::filesystem::path& folder) {
  const Json figures = Json::parse(read_whole_file(folder / "figures.json"));
  char text[200];
  if (figures["mean_px"].is_null()) {
    std::snprintf(text, sizeof text, "%s %d, %s: no tick counts", sequence.set.name.c_str(),
                  sequence.seed, contestant.c_str());
  } else {
    // Null by the paper's rules, which do not count lost ticks.
    const Json& lost = figures["lost_percent"];
    std::snprintf(
        text, sizeof text, "%s %d, %s: %.2f px, lost %s %%", sequence.set.name.c_str(),
        sequence.seed, contestant.c_str(), figures["mean_px"].get<double>(),
        number_text(lost.is_null() ? std::nullopt : std::optional(lost.get<double>()), 2).c_str());
  }
  return text;
}

}  // namespace

Experiment::Experiment(ExperimentSettings settings)
    : settings_(std::move(settings)),
      recordings_(settings_.output / "recordings"),
      results_(settings_.output / "results"),
      simulate_hash_(ContentHash().add_file(program("puck-simulate")).text()),
      calibrate_hash_(ContentHash().add_file(program("puck-calibrate")).text()),
      evaluate_hash_(ContentHash().add_file(program("puck-evaluate")).text()) {}

std::string Experiment::program(const std::string& name) const { return settings_.programs / name; }

std::string Experiment::recording_key(const Sequence& sequence) const {
  std::ostringstream key;
  key << "puck-simulate " << simulate_hash_ << " --seed " << sequence.seed << " --seconds "
      << sequence.seconds << (sequence.set.moving ? " --moving" : "") << '\n';
  if (!sequence.set.scene.empty()) {
    key << read_whole_file(settings_.scenes / sequence.set.scene) << '\n';
  }
  return key.str();
}

std::string Experiment::evaluation_key(const Sequence& sequence,
                                       const std::vector<std::string>& options) const {
  return "puck-evaluate " + evaluate_hash_ + joined(options) + '\n' + read_whole_file(size_model_) +
         (sequence.shown ? "with ticks\n" : "") + recording_key(sequence);
}

std::filesystem::path Experiment::record(const Sequence& sequence, Progress& progress) {
  const std::string name = sequence_name(sequence);
  const std::string key = recording_key(sequence);
  auto folder = recordings_.find(name, key);
  if (!folder) {
    double cpu_s = 0;
    folder = recordings_.make(name, key, [&](const std::filesystem::path& there) {
      std::ostringstream seconds;
      seconds << sequence.seconds;
      std::vector<std::string> command{
          program("puck-simulate"),      "--output",  there / "game", "--seed",
          std::to_string(sequence.seed), "--seconds", seconds.str()};
      if (sequence.set.moving) command.emplace_back("--moving");
      if (!sequence.set.scene.empty()) {
        command.insert(command.end(), {"--scene", settings_.scenes / sequence.set.scene});
      }
      cpu_s = run_or_throw(command, there);
      std::ofstream(there / "simulation.json") << Json{{"cpu_s", cpu_s}}.dump() << '\n';
    });
    char text[120];
    std::snprintf(text, sizeof text, "%s %d: %g s simulated in %.1f s of CPU time",
                  sequence.set.name.c_str(), sequence.seed, sequence.seconds, cpu_s);
    progress.finish(simulation_cost_s(sequence), text);
  } else {
    progress.skip(simulation_cost_s(sequence));
  }
  return *folder / "game";
}

void Experiment::calibrate() {
  if (!size_model_.empty()) return;
  const Sequence sequence = calibration_sequence();
  const std::string key = "puck-calibrate " + calibrate_hash_ + '\n' + recording_key(sequence);
  auto folder = results_.find("calibration", key);
  if (!folder) {
    Progress progress(1, simulation_cost_s(sequence));
    const std::filesystem::path recording = record(sequence, progress);
    folder = results_.make("calibration", key, [&](const std::filesystem::path& there) {
      const std::string size_model = there / "size.toml";
      run_or_throw({program("puck-calibrate"), "size", recording.string() + ".annotations.csv",
                    "--output", size_model},
                   there);
      run_or_throw(
          {program("puck-calibrate"), "lag", recording.string() + ".raw", "--truth",
           recording.string() + ".truth.csv", "--size-model", size_model, "--output", size_model},
          there);
    });
    if (!settings_.keep_recordings) {
      recordings_.remove(sequence_name(sequence), recording_key(sequence));
    }
  }
  size_model_ = *folder / "size.toml";
}

std::filesystem::path Experiment::evaluate(const Sequence& sequence, const std::string& name,
                                           const std::vector<std::string>& options,
                                           const std::filesystem::path& recording) {
  return results_.make(result_name(sequence, name), evaluation_key(sequence, options),
                       [&](const std::filesystem::path& there) {
                         std::vector<std::string> command{program("puck-evaluate"),
                                                          recording.string() + ".raw",
                                                          "--truth",
                                                          recording.string() + ".truth.csv",
                                                          "--size-model",
                                                          size_model_,
                                                          "--json",
                                                          there / "figures.json",
                                                          "--curves",
                                                          there};
                         if (sequence.shown)
                           command.insert(command.end(), {"--csv", there / "ticks.csv"});
                         command.insert(command.end(), options.begin(), options.end());
                         run_or_throw(command, there);
                       });
}

void Experiment::run(const Sequence& sequence, Progress& progress, std::vector<Result>& results,
                     std::vector<RecordingResult>& recordings) {
  const std::string made_name = result_name(sequence, "recording");
  const std::string made_key = recording_key(sequence) + (sequence.shown ? "with truth\n" : "");
  auto made = results_.find(made_name, made_key);
  const bool all_there =
      made && std::all_of(sequence.contestants.begin(), sequence.contestants.end(),
                          [&](const Contestant& contestant) {
                            return results_.find(result_name(sequence, contestant.name),
                                                 evaluation_key(sequence, contestant.options));
                          });
  std::filesystem::path recording;
  if (all_there) {
    progress.skip(simulation_cost_s(sequence));
  } else {
    recording = record(sequence, progress);
    made = results_.make(made_name, made_key, [&](const std::filesystem::path& there) {
      std::filesystem::copy_file(recording.parent_path() / "simulation.json",
                                 there / "simulation.json");
      if (sequence.shown) {
        std::filesystem::copy_file(recording.string() + ".truth.csv", there / "truth.csv");
      }
    });
  }
  recordings.push_back({sequence.set.name, sequence.seed, sequence.seconds, sequence.shown, *made});

  for (const Contestant& contestant : sequence.contestants) {
    auto folder = results_.find(result_name(sequence, contestant.name),
                                evaluation_key(sequence, contestant.options));
    if (folder) {
      progress.skip(evaluation_cost_s(sequence, contestant));
    } else {
      folder = evaluate(sequence, contestant.name, contestant.options, recording);
      progress.finish(evaluation_cost_s(sequence, contestant),
                      told(sequence, contestant.name, *folder));
    }
    results.push_back({sequence.set.name, sequence.seed, contestant.name, *folder});
  }
  if (!settings_.keep_recordings) {
    recordings_.remove(sequence_name(sequence), recording_key(sequence));
  }
}

ExperimentResults Experiment::run(const std::vector<Sequence>& sequences) {
  calibrate();
  int steps = 0;
  double cost = 0;
  for (const Sequence& sequence : sequences) {
    steps += 1 + static_cast<int>(sequence.contestants.size());
    cost += cost_s(sequence);
  }
  Progress progress(steps, cost);
  std::vector<std::vector<Result>> results(sequences.size());
  std::vector<std::vector<RecordingResult>> recordings(sequences.size());
  run_in_parallel(settings_.jobs, sequences.size(),
                  [&](std::size_t i) { run(sequences[i], progress, results[i], recordings[i]); });
  ExperimentResults all;
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    all.results.insert(all.results.end(), results[i].begin(), results[i].end());
    all.recordings.insert(all.recordings.end(), recordings[i].begin(), recordings[i].end());
  }
  return all;
}

}  // namespace puck
