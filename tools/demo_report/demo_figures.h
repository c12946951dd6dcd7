#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "tools/demo_report/game_log.h"

namespace puck {

/// Messages that arrived at all services together, on all channels, and what was wrong with them.
struct BusFigures {
  std::int64_t received = 0;
  std::int64_t lost = 0;
  std::int64_t late = 0;
  std::int64_t duplicate = 0;
  std::int64_t rejected = 0;  ///< Malformed, or too large.
  std::int64_t foreign = 0;   ///< Foreign datagrams on the same group and port.
  /// Counters that did not fit into a STATUS. A counter that is missing may be one of them, not 0.
  std::int64_t left_out = 0;
};

/// The figures of tools/demo.sh; empty where the logs do not have them.
struct DemoFigures {
  std::optional<std::int64_t> events_sent;
  std::optional<std::int64_t> events_received;
  std::optional<std::int64_t> events_lost;
  std::int64_t estimates = 0;
  std::optional<double> estimate_rate_hz;  ///< From the first estimate to the last.
  std::optional<double> mean_px;
  std::optional<double> median_px;
  std::optional<double> p95_px;
  std::optional<double> lost_percent;
  // As the tracker measures them; sensor_to_estimate is corrected for the offset of the camera's
  // clock.
  std::optional<LoggedLatency> packet_to_estimate;
  std::optional<LoggedLatency> sensor_to_estimate;
  std::optional<LoggedLatency> backlog;
  std::optional<LoggedLatency> estimate_to_command;  ///< As the bridge measures it.
  std::optional<std::int64_t> shots;
  std::optional<std::int64_t> saves;
  std::optional<std::int64_t> goals_against;
  std::optional<std::int64_t> replay_estimates;
  std::optional<double> replay_mean_difference_px;

  BusFigures bus;

  // The counts of the bridge, which sees estimates only.
  std::optional<std::int64_t> believed_shots;
  std::optional<std::int64_t> believed_saves;
  std::optional<std::int64_t> believed_goals_against;
};

/// `replay`: the log of a second tracker that was fed with the events of `game`; may be null.
DemoFigures demo_figures(const GameLog& game, const GameLog* replay);

/// One flat object; what is missing is null. An interrupted call leaves no half-written file.
/// Throws std::runtime_error when it cannot be written.
void write_json(const DemoFigures& figures, const std::filesystem::path& path);

}  // namespace puck
