#include "services/launch/rate_limited_log.h"

namespace puck {

void RateLimitedLog::warn(std::string_view subject, std::string_view message,
                          Clock::time_point now) {
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
    log_.warn("{}: {}", subject, message);
  } else {
    log_.warn("{}: {} ({} more like it not shown)", subject, message, suppressed);
  }
  silent_until = now + kSilence;
  suppressed = 0;
}

}  // namespace puck
