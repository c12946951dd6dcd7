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

/// Writes about each subject at most once a second, with the number of suppressed lines. For events
/// that may happen thousands of times a second. Safe from any thread.
class RateLimitedLog {
 public:
  using Clock = std::chrono::steady_clock;

  explicit RateLimitedLog(spdlog::logger& log) : log_(log) {}

  void warn(std::string_view subject, std::string_view message) {
    write(spdlog::level::warn, subject, message, Clock::now());
  }
  void info(std::string_view subject, std::string_view message) {
    write(spdlog::level::info, subject, message, Clock::now());
  }
  /// With a given time, for tests.
  void warn(std::string_view subject, std::string_view message, Clock::time_point now) {
    write(spdlog::level::warn, subject, message, now);
  }

 private:
  struct Subject {
    Clock::time_point silent_until;
    std::int64_t suppressed = 0;
  };

  void write(spdlog::level::level_enum level, std::string_view subject, std::string_view message,
             Clock::time_point now);

  spdlog::logger& log_;
  std::mutex mutex_;
  std::map<std::string, Subject, std::less<>> subjects_;  // Guarded by mutex_.
};

}  // namespace puck
