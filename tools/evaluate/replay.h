#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/io/event_reader.h"
#include "tools/evaluate/runs.h"

namespace puck {

/// Comparison of a log's estimates with those repeated from its events.
struct ReplayComparison {
  std::int64_t estimates = 0;  ///< Recorded ones with new events; all are repeated.
  std::int64_t repeated = 0;   ///< Recorded ones without new events; not compared.
  std::int64_t equal = 0;      ///< Equal to the bit, except host times and packet counts.
  std::int64_t state_differs = 0;
  /// Where both have a position.
  std::optional<double> mean_difference_px;
  std::optional<double> max_difference_px;
  /// Known reasons for unequal estimates, for people.
  std::vector<std::string> notes;
};

struct ReplayResult {
  RunSummary run;
  ReplayComparison comparison;
};

/// Feeds a tracker with the events of a log, packet by packet, and queries it after as many events
/// as each recorded estimate had: no event is thinned, each search runs at its sensor time. Two
/// runs are equal to the bit, and to the recorded run if that had tracker.reproducible and the same
/// settings. Calls `on_tick` for each estimate.
///
/// `events` are those of the log at `path`, whose channels have the prefix. Throws LogFileError for
/// a log without estimates based on them.
ReplayResult run_replay(EventReader& events, const std::filesystem::path& path,
                        const std::string& prefix, const TrackerSetup& setup,
                        const OnTick& on_tick);

}  // namespace puck
