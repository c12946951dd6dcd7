#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include <spdlog/logger.h>

#include "services/launch/line_writer.h"

namespace puck {

/// Log of a service: "12:34:56.789 puck-arm info: text", coloured on a terminal. Never waits for
/// its reader (see LineWriter). Safe from any thread.
class ServiceLog {
 public:
  ServiceLog(const std::string& name, int descriptor);

  spdlog::logger& logger() { return logger_; }
  std::size_t lost_lines() const { return writer_.lost(); }

 private:
  LineWriter writer_;
  spdlog::logger logger_;
};

}  // namespace puck
