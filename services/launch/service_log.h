#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include <spdlog/logger.h>

namespace spdlog::details {
class thread_pool;
}

namespace puck {

/// The log of a service. That of a real-time loop is written by a thread of its own, so that the
/// loop keeps its pace whatever becomes of its standard error: up to 256 lines wait, and of more
/// the oldest are lost and counted. What waits is written when it ends. Safe from any thread.
class ServiceLog {
 public:
  ServiceLog(const std::string& name, spdlog::sink_ptr sink, bool is_real_time);

  spdlog::logger& logger() { return *logger_; }
  std::size_t lost_lines() const;

 private:
  std::shared_ptr<spdlog::details::thread_pool> writers_;  // Null: whoever logs writes.
  std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace puck
