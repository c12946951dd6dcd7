#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "puck/arm_command_t.hpp"
#include "puck/arm_state_t.hpp"
#include "puck/puck_estimate_t.hpp"
#include "puck/service_status_t.hpp"

namespace puck {

/// A message and when the logger received it, CLOCK_REALTIME, µs: one clock for all machines.
template <typename Message>
struct Heard {
  std::int64_t at_us = 0;
  Message message;
};

/// Publishers, messages and their times under a prefix, from a log.
struct BusLog {
  std::vector<Heard<puck_estimate_t>> estimates;
  std::vector<Heard<service_status_t>> statuses;
  std::vector<Heard<arm_state_t>> arm_states;
  std::vector<Heard<arm_command_t>> commands;
  std::set<std::int64_t> events_sessions;
  std::vector<Heard<std::size_t>> events_datagrams;  ///< Their sizes, bytes.
  /// Times at which each session was received, on any channel.
  std::map<std::int64_t, std::vector<std::int64_t>> heard_us;
  /// Without STATUS, which is cut to a frame and grows with its counters.
  std::size_t largest_datagram_bytes = 0;
  std::string largest_datagram_channel;
};

/// Malformed messages are left out. Throws LogFileError without such a log.
BusLog read_bus_log(const std::filesystem::path& path, const std::string& prefix);

/// One session of a service, from its STATUS.
struct ServiceRun {
  std::int64_t session = 0;
  std::int64_t started_us = 0;  ///< As it states.
  service_status_t last;

  /// From the last STATUS; nothing if that lacks it.
  std::optional<std::int64_t> counter(const std::string& name) const;
  /// The same for a counter that is reported unless it is 0; nothing if STATUS may have left it out
  /// for lack of room.
  std::optional<std::int64_t> rare_counter(const std::string& name) const;
  bool has_said_goodbye() const { return last.state == service_status_t::STATE_STOPPING; }
};

/// In the order of their first messages.
std::vector<ServiceRun> runs_of(const BusLog& log, const std::string& service);

/// A time without any message of a session.
struct Silence {
  std::int64_t begin_us = 0;  ///< Its last message before …
  std::int64_t end_us = 0;    ///< … and its first one after.
};
/// The longest one; nothing with fewer than two messages.
std::optional<Silence> longest_silence(const BusLog& log, std::int64_t session);

}  // namespace puck
