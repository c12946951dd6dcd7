#include "tools/compare/sequence_plan.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace puck {
namespace {

constexpr const char* kParticleFilter = "particle-filter";

}  // namespace

std::vector<Contestant> contestants() {
  std::vector<Contestant> all{{"cluster", {"--algorithm", "cluster"}, 0.05},
                              {kParticleFilter, {"--algorithm", kParticleFilter}, 1.8}};
  for (const std::string preset : {"paper", "reference", "correlation"}) {
    for (const std::string surface : {"tos", "sits", "sae"}) {
      all.push_back({.name = preset + "-" + surface,
                     .options = {"--preset", preset, "--surface", surface},
                     .only_by_name = true});
    }
    all.push_back({preset, {"--preset", preset}});
  }
  all.push_back({"default", {"--preset", "default"}});
  return all;
}

std::vector<SequenceSet> sequence_sets() {
  std::vector<SequenceSet> sets{
      {.name = "still",
       .title = "still camera",
       .first_seed = 1001,
       .shown = true,
       .published = "2.47 px, 80 % within 3.5 px"},
      {.name = "moving",
       .title = "moving camera",
       .moving = true,
       .first_seed = 1101,
       .shown = true,
       .published = "2.81 px, 80 % within 4 px"},
      {.name = "low-contrast-still",
       .title = "low contrast, 6 m/s, still",
       .scene = "low_contrast_6_m_s.toml",
       .shown = true},
      {.name = "low-contrast-moving",
       .title = "low contrast, 5 m/s, moving",
       .scene = "low_contrast_5_m_s.toml",
       .moving = true,
       .shown = true},
      {.name = "logos-moving",
       .title = "round logos, moving",
       .scene = "round_logos.toml",
       .moving = true},
      {.name = "fast-still",
       .title = "shots to 15 m/s, still",
       .scene = "fast_shots.toml",
       .shown = true},
      {.name = "fast-moving",
       .title = "shots to 15 m/s, moving",
       .scene = "fast_shots.toml",
       .moving = true},
      {.name = "dim", .title = "dim light, still", .scene = "dim_light.toml"},
      {.name = "flicker", .title = "flicker, still", .scene = "flicker.toml"},
      {.name = "hot-pixels", .title = "hot pixels, still", .scene = "hot_pixels.toml"},
      {.name = "rests", .title = "rests, still", .scene = "rests.toml"},
      {.name = "occlusion", .title = "occlusion, still", .scene = "occlusion.toml"},
      {.name = "goals", .title = "goals: off the table and back", .scene = "goals.toml"},
      {.name = "leaves-image",
       .title = "leaves the image, moving",
       .scene = "leaves_image.toml",
       .moving = true},
      {.name = "second-puck", .title = "second puck, still", .scene = "second_puck.toml"},
      {.name = "noisy", .title = "noisy sensor, rests, still", .scene = "noisy_sensor.toml"},
      {.name = "printed",
       .title = "a ring printed on the puck, still",
       .scene = "printed_puck.toml"}};
  int next_hard_seed = 1201;
  for (SequenceSet& set : sets) {
    if (set.scene.empty()) continue;
    set.is_hard = true;
    set.first_seed = next_hard_seed;
    next_hard_seed += 10;
  }
  return sets;
}

SequenceSet set_of(const std::vector<SequenceSet>& sets, const std::string& name) {
  const auto found =
      std::find_if(sets.begin(), sets.end(), [&](const auto& set) { return set.name == name; });
  if (found == sets.end()) throw std::invalid_argument("no set of sequences is called " + name);
  return *found;
}

std::vector<Contestant> PlanOptions::included() const {
  std::vector<Contestant> all = contestants();
  std::erase_if(all, [&](const Contestant& each) {
    if (only.empty()) return each.only_by_name;
    return std::find(only.begin(), only.end(), each.name) == only.end();
  });
  return all;
}

int sequences_of(const SequenceSet& set, const PlanOptions& options) {
  return set.is_hard ? std::max(options.sequences / 2, 1) : options.sequences;
}

double seconds_of(const SequenceSet& set, const PlanOptions& options) {
  if (!set.is_hard) return options.seconds;
  return std::min(std::clamp(std::round(options.seconds / 3), 2.0, 10.0), options.seconds);
}

std::vector<Sequence> plan_sequences(const PlanOptions& options) {
  std::vector<Sequence> sequences;
  for (const SequenceSet& set : sequence_sets()) {
    for (int i = 0; i < sequences_of(set, options); ++i) {
      Sequence sequence{.set = set,
                        .seed = set.first_seed + i,
                        .seconds = seconds_of(set, options),
                        .shown = set.shown && i == 0};
      for (const Contestant& contestant : options.included()) {
        if (set.is_hard && contestant.name == kParticleFilter) continue;
        sequence.contestants.push_back(contestant);
      }
      sequences.push_back(sequence);
    }
  }
  if (options.scoring != "ours") {
    for (Sequence& sequence : sequences) {
      for (Contestant& contestant : sequence.contestants) {
        contestant.options.insert(contestant.options.end(), {"--scoring", options.scoring});
      }
    }
  }
  std::stable_sort(sequences.begin(), sequences.end(),
                   [](const Sequence& a, const Sequence& b) { return cost_s(a) > cost_s(b); });
  return sequences;
}

Sequence calibration_sequence() {
  return {.set = {.name = "calibration", .title = "calibration"}, .seed = 1, .seconds = 10};
}

Sequence latency_sequence(const PlanOptions& options, double seconds) {
  Sequence sequence{.set = {.name = "latency", .title = "latency"},
                    .seed = 2,
                    .seconds = std::min(options.seconds / 3, seconds)};
  for (Contestant& contestant : options.included()) {
    contestant.options.emplace_back("--real-time");
    contestant.cost = 1;
    sequence.contestants.push_back(contestant);
  }
  return sequence;
}

double simulation_cost_s(const Sequence& sequence) {
  return sequence.seconds * (sequence.set.moving ? 2.2 : 0.4);
}

double evaluation_cost_s(const Sequence& sequence, const Contestant& contestant) {
  return sequence.seconds * contestant.cost;
}

double cost_s(const Sequence& sequence) {
  double cost = simulation_cost_s(sequence);
  for (const Contestant& contestant : sequence.contestants) {
    cost += evaluation_cost_s(sequence, contestant);
  }
  return cost;
}

}  // namespace puck
