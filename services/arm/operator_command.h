#pragma once

#include <optional>
#include <stop_token>

#include "common/messaging/bus.h"

namespace CLI {
class App;
}

namespace puck {

/// `puck-arm --stop` and `puck-arm --reset`: an operator's commands to the arms on the bus.
class OperatorCommand {
 public:
  void add_options(CLI::App& app);

  /// Publishes the requested mode repeatedly for at least 200 ms, until every arm that is heard
  /// confirms it (see AddressedArms). Returns exit code 0; 1, with the reason on stderr, after 1 s
  /// without confirmation; nothing if no mode was requested. A stop is sent even if no arm is
  /// heard; a reset names each arm's session.
  std::optional<int> run(const BusParams& params, std::stop_token stop) const;

 private:
  bool stop_ = false;
  bool reset_ = false;
};

}  // namespace puck
