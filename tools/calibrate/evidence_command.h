#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/io/event_reader.h"

namespace puck {

/// Lists have one entry for each recording; those that say so may have a single one for all.
struct EvidenceCommand {
  std::vector<std::filesystem::path> recordings;
  std::vector<std::filesystem::path> truths;
  std::vector<std::filesystem::path> size_models;  ///< Or one.
  std::vector<double> truth_gaps_ms{10};           ///< Or one.
  std::vector<double> weights{1};                  ///< Or one.
  /// Those with other things that look exactly like the puck.
  std::vector<std::filesystem::path> with_lookalikes;
  std::filesystem::path output;
  EventFileOptions file;
};

/// Fits the numbers that preset default has learned to recordings with truth, and prints how well
/// they tell the puck from all else in each. `typed`: the command line, for a comment in the file.
/// Throws an exception that names the unusable file and the reason.
void calibrate_evidence(const EvidenceCommand& command, const std::string& typed);

}  // namespace puck
