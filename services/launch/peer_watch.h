#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <spdlog/logger.h>

#include "common/messaging/status_reporter.h"
#include "services/launch/peer_book.h"

namespace puck {

/// Says on the log and in STATUS when a service that this one lives on has fallen silent, or one is
/// there twice; so that no service has to. It ends and refuses nothing. One thread.
class PeerWatch {
 public:
  /// Listens to `status`; so make it before the bus starts.
  PeerWatch(StatusReporter& status, spdlog::logger& log);

  /// The services that this one lives on: puck-camera, …
  void need(const std::vector<std::string>& services) { book_.need(services); }

  /// Looks at all of them when it is due, and tells what is new.
  void poll();

  /// For a person: who publishes under this session.
  std::string name_of(std::int64_t session) const { return book_.name_of(session); }

  /// Adds `clock_offset_us puck-camera` and so on of each service that is heard: how far its clock
  /// is ahead of ours. A name that is longer than 32 bytes is cut there.
  void report(StatusReport& report) const;

 private:
  StatusReporter& status_;
  spdlog::logger& log_;
  PeerBook book_;
  std::int64_t due_us_ = 0;  // CLOCK_MONOTONIC
};

}  // namespace puck
