#include "tools/calibrate/evidence_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/calibration/evidence_fit.h"
#include "common/io/evidence_file.h"
#include "tools/calibrate/evidence_packets.h"

namespace puck {
namespace {

void check_count(const char* option, std::size_t count, std::size_t recordings, bool one_for_all) {
  if (count == recordings || (one_for_all && count == 1)) return;
  throw std::runtime_error(std::string(option) + " takes one value for each recording" +
                           (one_for_all ? ", or one for all" : "") + ": got " +
                           std::to_string(count) + " for " + std::to_string(recordings));
}

void check(const EvidenceCommand& command) {
  const std::size_t count = command.recordings.size();
  check_count("--truth", command.truths.size(), count, false);
  check_count("--size-model", command.size_models.size(), count, true);
  check_count("--truth-gap-ms", command.truth_gaps_ms.size(), count, true);
  check_count("--weight", command.weights.size(), count, true);
  for (const auto& path : command.with_lookalikes) {
    if (std::count(command.recordings.begin(), command.recordings.end(), path) > 0) continue;
    throw std::runtime_error("--lookalikes " + path.string() +
                             ": is not one of the recordings as they are written");
  }
}

template <typename T>
const T& of(std::size_t recording, const std::vector<T>& values) {
  return values[values.size() == 1 ? 0 : recording];
}

EvidenceSource source_of(const EvidenceCommand& command, std::size_t i) {
  const auto& recording = command.recordings[i];
  return {.recording = recording,
          .truth = command.truths[i],
          .size_model = of(i, command.size_models),
          .truth_gap_us = std::llround(1e3 * of(i, command.truth_gaps_ms)),
          .has_lookalikes = std::count(command.with_lookalikes.begin(),
                                       command.with_lookalikes.end(), recording) > 0};
}

EvidencePackets collect(const EvidenceSource& source, const EventFileOptions& file) {
  try {
    return collect_evidence(source, file);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(source.recording.string() + ": " + error.what());
  }
}

std::string text_of(const std::optional<double>& value) {
  if (!value) return "-";
  char text[40];
  std::snprintf(text, sizeof text, "%.4f", *value);
  return text;
}

void print(const EvidenceCommand& command, const std::vector<LabelledRecording>& recordings,
           const EvidenceParams& fitted) {
  std::printf("packets of: puck     other        AUC   log loss   log loss as built in\n");
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const std::vector<LabelledPacket>& packets = recordings[i].packets;
    const EvidenceQuality before = quality_of(packets, {});
    const EvidenceQuality after = quality_of(packets, fitted);
    std::printf("%16zu %9zu %10s %10s %10s   %s\n", after.pucks, after.others,
                text_of(after.auc).c_str(), text_of(after.log_loss).c_str(),
                text_of(before.log_loss).c_str(), command.recordings[i].c_str());
  }
}

// In lines that can be read and copied: many recordings make a long command.
std::string folded(const std::string& typed) {
  constexpr std::size_t kColumns = 96;
  std::istringstream words(typed);
  std::string text;
  std::string word;
  std::size_t column = 0;
  while (words >> word) {
    const bool is_new = word.starts_with("--") || column + word.size() > kColumns;
    const std::string before = text.empty() ? "" : is_new ? " \\\n    " : " ";
    text += before + word;
    column = (is_new ? 0 : column) + before.size() + word.size();
  }
  return text;
}

}  // namespace

void calibrate_evidence(const EvidenceCommand& command, const std::string& typed) {
  check(command);
  std::vector<LabelledRecording> recordings;
  for (std::size_t i = 0; i < command.recordings.size(); ++i) {
    const EvidenceSource source = source_of(command, i);
    EvidencePackets collected = collect(source, command.file);
    std::printf("%s: %zu packets, %zu without a label, %zu with the wrong side wall\n",
                source.recording.c_str(), collected.packets.size(), collected.left_out,
                collected.wrong_wall);
    std::fflush(stdout);
    recordings.push_back({std::move(collected.packets), of(i, command.weights)});
  }
  EvidenceParams fitted;
  try {
    fitted = fit_evidence(recordings);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(std::string("the recordings: ") + error.what());
  }
  write_evidence_file(command.output, fitted, folded(typed));
  print(command, recordings, fitted);
}

}  // namespace puck
