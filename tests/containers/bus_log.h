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

/// What a log says of who spoke when under a prefix.
struct BusLog {
  std::vector<Heard<puck_estimate_t>> estimates;
  std::vector<Heard<service_status_t>> statuses;
  std::vector<Heard<arm_state_t>> arm_states;
  std::vector<Heard<arm_command_t>> commands;
  std::set<std::int64_t> events_sessions;
  std::vector<Heard<std::size_t>> events_datagrams;  ///< Their sizes, bytes.
  /// When each session was heard, on any channel.
  std::map<std::int64_t, std::vector<std::int64_t>> heard_us;
  /// But for STATUS, which fits as long as all is well and grows with what there is to count.
  std::size_t largest_datagram_bytes = 0;
  std::string largest_datagram_channel;
};

/// Malformed messages are left out. Throws LogFileError when there is no such log.
BusLog read_bus_log(const std::filesystem::path& path, const std::string& prefix);

/// One life of a service, as its STATUS tells it.
struct ServiceRun {
  std::int64_t session = 0;
  std::int64_t started_us = 0;  ///< By its own word.
  service_status_t last;

  /// From the last STATUS; nothing when that does not have it.
  std::optional<std::int64_t> counter(const std::string& name) const;
  /// The same of a counter that a service reports unless it is 0; nothing when it may have been
  /// left out for want of room.
  std::optional<std::int64_t> rare_counter(const std::string& name) const;
  bool has_said_goodbye() const { return last.state == service_status_t::STATE_STOPPING; }
};

/// In the order of their first words.
std::vector<ServiceRun> runs_of(const BusLog& log, const std::string& service);

/// A time in which a session was not heard at all.
struct Silence {
  std::int64_t begin_us = 0;  ///< Its last word before …
  std::int64_t end_us = 0;    ///< … and its first one after.
};
/// The longest; nothing when it was heard less than twice.
std::optional<Silence> longest_silence(const BusLog& log, std::int64_t session);

}  // namespace puck
