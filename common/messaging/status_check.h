#pragma once

#include <chrono>
#include <stop_token>
#include <string>

#include "common/messaging/bus.h"

namespace puck {

struct StatusCheck {
  bool healthy = false;
  std::string text;  ///< For people: the status heard, or the reason for none.
};

/// For `--check`: listens for the STATUS of the named service. Healthy: running, or waiting for
/// input. Returns at the first healthy status, else after `timeout`. The bus must not be started
/// yet.
StatusCheck check_service(const BusParams& params, const std::string& service,
                          std::chrono::milliseconds timeout, std::stop_token stop);

}  // namespace puck
