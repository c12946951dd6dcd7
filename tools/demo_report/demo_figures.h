#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "tools/demo_report/game_log.h"

namespace puck {

/// What came to all services together, on all channels, and what of it was not as it should be.
struct BusFigures {
  std::int64_t received = 0;
  std::int64_t lost = 0;
  std::int64_t late = 0;
  std::int64_t duplicate = 0;
  std::int64_t rejected = 0;  ///< Malformed; those that are too large among them.
  std::int64_t foreign = 0;   ///< Datagrams of somebody else at the same group and port.
  /// Counters that their STATUS had no room for: one that is missing may be one of these, not 0.
  std::int64_t left_out = 0;
};

/// The figures of tools/demo.sh; what the logs do not say is missing.
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
  // As the tracker measures them; its STATUS says more exactly what each is. sensor_to_estimate is
  // corrected for the offset of the camera's clock.
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

  // What the bridge believes; the truth stands above.
  std::optional<std::int64_t> believed_shots;
  std::optional<std::int64_t> believed_saves;
  std::optional<std::int64_t> believed_goals_against;
};

/// `replay` is the log of a second tracker that was fed with the events of `game`.
DemoFigures demo_figures(const GameLog& game, const GameLog* replay);

void print(const DemoFigures& figures);

/// One flat object; what is missing is null. Throws std::runtime_error when it cannot be written.
void write_json(const DemoFigures& figures, const std::filesystem::path& path);

}  // namespace puck
