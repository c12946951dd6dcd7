#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include <spdlog/logger.h>

namespace puck {

/// Warns at most once a second about one subject, and says how often it kept silent. For what can
/// happen thousands of times a second. Safe from any thread.
class RateLimitedLog {
 public:
  using Clock = std::chrono::steady_clock;

  explicit RateLimitedLog(spdlog::logger& log) : log_(log) {}

  void warn(std::string_view subject, std::string_view message) {
    warn(subject, message, Clock::now());
  }
  /// With the time given, for tests.
  void warn(std::string_view subject, std::string_view message, Clock::time_point now);

 private:
  struct Subject {
    Clock::time_point silent_until;
    std::int64_t suppressed = 0;
  };

  spdlog::logger& log_;
  std::mutex mutex_;
  std::map<std::string, Subject, std::less<>> subjects_;  // Guarded by mutex_.
};

}  // namespace puck
