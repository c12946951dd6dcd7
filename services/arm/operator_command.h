#pragma once

#include <optional>
#include <stop_token>

#include "common/messaging/bus.h"

namespace CLI {
class App;
}

namespace puck {

/// `puck-arm --stop` and `puck-arm --reset`: a person's word to the arms on the bus.
class OperatorCommand {
 public:
  void add_options(CLI::App& app);

  /// Publishes the mode that was asked for, many times over at least 200 ms, until every arm that
  /// is heard confirms it (AddressedArms says which are): exit code 0; 1, and the reason on stderr,
  /// when that takes more than 1 s. Nothing when no mode was asked for. A stop goes out whether an
  /// arm is heard or not; a reset answers each arm's session.
  std::optional<int> run(const BusParams& params, std::stop_token stop) const;

 private:
  bool stop_ = false;
  bool reset_ = false;
};

}  // namespace puck
