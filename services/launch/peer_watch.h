#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <spdlog/logger.h>

#include "common/messaging/status_reporter.h"
#include "services/launch/peer_book.h"

namespace puck {

/// Reports, in the log and in STATUS, required services that fall silent and services that run
/// twice. It ends and refuses nothing. One thread.
class PeerWatch {
 public:
  /// Listens to `status`, so make it before the bus starts.
  PeerWatch(StatusReporter& status, spdlog::logger& log);

  /// Sets the services that this one requires: puck-camera, …
  void need(const std::vector<std::string>& services) { book_.need(services); }

  /// Looks at all services when due, and logs changes.
  void poll();

  /// Name of the publisher of this session, for people.
  std::string name_of(std::int64_t session) const { return book_.name_of(session); }

  /// Adds `clock_offset_us puck-camera` and so on for each service heard: its clock minus ours.
  /// Names are cut to 32 bytes.
  void report(StatusReport& report) const;

 private:
  StatusReporter& status_;
  spdlog::logger& log_;
  PeerBook book_;
  std::int64_t due_us_ = 0;  // CLOCK_MONOTONIC
};

}  // namespace puck
