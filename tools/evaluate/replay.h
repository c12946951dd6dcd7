#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/io/event_reader.h"
#include "tools/evaluate/runs.h"

namespace puck {

/// How the estimates of a log compare with those that its events give once more.
struct ReplayComparison {
  std::int64_t estimates = 0;  ///< Recorded ones with new events: each is made again.
  std::int64_t repeated = 0;   ///< Recorded ones without; nothing new can be asked there.
  std::int64_t equal = 0;      ///< Made again to the bit: all but host times and counts of packets.
  std::int64_t state_differs = 0;
  /// Between the positions where both have one.
  std::optional<double> mean_difference_px;
  std::optional<double> max_difference_px;
  /// Why they cannot all be equal, for a person, as far as the log tells.
  std::vector<std::string> notes;
};

struct ReplayResult {
  RunSummary run;
  ReplayComparison comparison;
};

/// Feeds a tracker with the events of a log, packet by packet, and asks it after as many of them as
/// each recorded estimate rests on: nothing is thinned, each search is made at its sensor time. Two
/// runs are equal to the bit, and equal to the recorded one if that tracker ran with
/// tracker.reproducible and the same settings. A tick for each estimate goes to `on_tick`.
///
/// `events` are those of the log at `path`, whose channels have the prefix. Throws LogFileError for
/// a log without estimates that rest on them.
ReplayResult run_replay(EventReader& events, const std::filesystem::path& path,
                        const std::string& prefix, const TrackerSetup& setup,
                        const OnTick& on_tick);

}  // namespace puck
