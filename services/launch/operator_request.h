#pragma once

#include <cstdint>
#include <stop_token>
#include <string>

#include "common/messaging/bus.h"
#include "common/messaging/status_reporter.h"

namespace puck {

/// What a person asks of services on the bus from a command line: puck-arm --stop, puck-camera
/// --pause. One thread.
class OperatorRequest {
 public:
  virtual ~OperatorRequest() = default;

  /// Subscribes to what confirms it. Called before the bus starts; both arguments outlive it.
  virtual void listen(Bus& bus, StatusReporter& status) = 0;
  /// Publishes it once, to all that it addresses; returns whether there is anyone.
  virtual bool publish(Bus& bus) = 0;
  /// Why it is not confirmed; empty: it is.
  virtual std::string why_not() const = 0;
  /// Why it was refused, so that waiting is useless; empty: it was not.
  virtual std::string refusal() const { return {}; }
  /// Whether it is being carried out, so that its time does not run out.
  virtual bool is_in_progress() const { return false; }
  /// The state that it asks for: "stopped"; it stands behind "puck-arm: " and "to be ".
  virtual std::string goal() const = 0;
  /// The same once it is confirmed.
  virtual std::string result() const { return goal(); }
};

struct OperatorParams {
  std::string program;           ///< Before its messages: puck-arm.
  std::int64_t at_least_us = 0;  ///< So long it is published, also if it is answered earlier.
  /// Gives up after so long without a sign that it is being carried out …
  std::int64_t give_up_us = 1'000'000;
  /// … and after so long in any case.
  std::int64_t longest_us = 60'000'000;
};

/// Publishes the request every 20 ms until it is confirmed. Returns the exit code: 0 with the
/// result on stdout; 1 with the reason on stderr if it is refused, or not confirmed in time.
int make_operator_request(const OperatorParams& operation, const BusParams& params,
                          OperatorRequest& request, std::stop_token stop);

}  // namespace puck
