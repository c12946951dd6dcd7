#include "services/launch/rate_limited_log.h"

#include <spdlog/fmt/fmt.h>

namespace puck {

void RateLimitedLog::write(spdlog::level::level_enum level, std::string_view subject,
                           std::string_view message, Clock::time_point now) {
  constexpr std::chrono::seconds kSilence{1};
  const std::lock_guard lock(mutex_);
  auto found = subjects_.find(subject);
  if (found == subjects_.end()) found = subjects_.emplace(subject, Subject{}).first;
  auto& [silent_until, suppressed] = found->second;
  if (now < silent_until) {
    ++suppressed;
    return;
  }
  if (suppressed == 0) {
    log_.log(level, fmt::format("{}: {}", subject, message));
  } else {
    log_.log(level,
             fmt::format("{}: {} ({} more like it not shown)", subject, message, suppressed));
  }
  silent_until = now + kSilence;
  suppressed = 0;
}

}  // namespace puck
