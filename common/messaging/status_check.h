#pragma once

#include <chrono>
#include <stop_token>
#include <string>

#include "common/messaging/bus.h"

namespace puck {

struct StatusCheck {
  bool healthy = false;
  std::string text;  ///< For a person: what was heard, or that nothing was.
};

/// For `--check`: listens for the STATUS of a service of this name. Healthy: it runs, or waits for
/// its input. Returns at the first healthy status, else after `timeout`. The bus must not have been
/// started.
StatusCheck check_service(const BusParams& params, const std::string& service,
                          std::chrono::milliseconds timeout, std::stop_token stop);

}  // namespace puck
