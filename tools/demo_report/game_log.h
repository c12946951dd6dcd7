#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/vision/geometry/truth_row.h"
#include "puck/game_state_t.hpp"
#include "puck/ground_truth_t.hpp"
#include "puck/puck_estimate_t.hpp"

namespace puck {

/// Over a service's whole run.
struct LoggedLatency {
  std::int64_t p50_us = 0;
  std::int64_t p99_us = 0;
  std::int64_t max_us = 0;
};

/// The part of a game's log that a report needs.
struct GameLog {
  std::vector<puck_estimate_t> estimates;
  std::vector<TruthRow> truth;
  std::optional<ground_truth_t> last_truth;
  std::optional<game_state_t> last_game;
  /// Newest counters, by service and name.
  std::map<std::string, std::map<std::string, std::int64_t>> counters;
  /// Newest latencies that have samples, by service and name.
  std::map<std::string, std::map<std::string, LoggedLatency>> latencies;
  std::int64_t rejected = 0;  ///< Malformed messages on PUCK channels.

  std::optional<std::int64_t> counter(const std::string& service, const std::string& name) const;
  std::optional<LoggedLatency> latency(const std::string& service, const std::string& name) const;
};

/// Reads the channels under a prefix. Throws LogFileError if the file is missing or not an LCM log.
GameLog read_game_log(const std::filesystem::path& path, const std::string& prefix = "");

}  // namespace puck
