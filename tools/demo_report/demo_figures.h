#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "tools/demo_report/game_log.h"

namespace puck {

/// Message counts over all services and channels.
struct BusFigures {
  std::int64_t received = 0;
  std::int64_t lost = 0;
  std::int64_t late = 0;
  std::int64_t duplicate = 0;
  std::int64_t rejected = 0;  ///< Malformed, or too large.
  std::int64_t foreign = 0;   ///< Foreign datagrams on the same group and port.
  /// Counters that did not fit into STATUS: a missing counter may be one of them instead of 0.
  std::int64_t left_out = 0;
};

/// The figures of tools/demo.sh; empty if the logs lack them.
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
  // Measured by the tracker; sensor_to_estimate is corrected for the offset of the camera's clock.
  std::optional<LoggedLatency> packet_to_estimate;
  std::optional<LoggedLatency> sensor_to_estimate;
  std::optional<LoggedLatency> backlog;
  std::optional<LoggedLatency> estimate_to_command;  ///< Measured by the bridge.
  std::optional<std::int64_t> shots;
  std::optional<std::int64_t> saves;
  std::optional<std::int64_t> goals_against;
  std::optional<std::int64_t> replay_estimates;
  /// Where the truth, if there is one, has the puck in sight.
  std::optional<double> replay_mean_difference_px;

  BusFigures bus;

  // Counted by the bridge from estimates.
  std::optional<std::int64_t> believed_shots;
  std::optional<std::int64_t> believed_saves;
  std::optional<std::int64_t> believed_goals_against;
};

/// `replay`: the log of a second tracker on the events of `game`; may be null.
DemoFigures demo_figures(const GameLog& game, const GameLog* replay);

/// Writes one flat object with null for missing values, or, when interrupted, nothing. Throws
/// std::runtime_error when the file cannot be written.
void write_json(const DemoFigures& figures, const std::filesystem::path& path);

}  // namespace puck
