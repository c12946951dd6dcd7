#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "common/evaluation/accuracy_score.h"
#include "common/io/event_reader.h"
#include "tools/command_line/event_filter_options.h"
#include "tools/evaluate/lossy_reader.h"
#include "tools/evaluate/part_reader.h"

namespace puck {

/// Options of the command line.
struct EvaluateOptions {
  std::filesystem::path events;
  std::filesystem::path truth;
  std::filesystem::path size_model;
  std::filesystem::path evidence;
  std::vector<std::string> scale_decision;  // NAME=FACTOR
  EventFilterOptions filter;
  std::filesystem::path json;
  std::filesystem::path csv;
  std::filesystem::path curves;
  std::filesystem::path plots;
  std::string algorithm = "puck";
  std::string preset = "default";
  std::string surface = "eros";
  std::string detection_region;
  bool roi_only = false;
  std::int64_t search_delay_us = 0;
  double rate_hz = 1000;
  bool real_time = false;
  bool as_fast_as_possible = false;
  bool replay = false;
  bool exact = false;
  double max_difference_px = 0.5;
  AccuracyParams accuracy;
  bool has_truth_gap = false;  ///< Set by an option.
  bool score_at_marks = false;
  bool no_puck = false;
  std::string scoring = "ours";
  std::string prefix;
  RecordingPart part;
  bool drops_packets = false;
  LossyReaderParams loss;
  EventFileOptions file;
};

/// `options` must outlive the parsing.
void add_options(CLI::App& app, EvaluateOptions& options);

}  // namespace puck
