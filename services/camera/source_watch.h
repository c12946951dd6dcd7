#pragma once

#include <cstdint>

#include "services/camera/event_source.h"
#include "services/launch/rate_limited_log.h"

namespace puck {

/// Warns of what a source drops or cannot read. One thread.
class SourceWatch {
 public:
  explicit SourceWatch(RateLimitedLog& log) : log_(log) {}

  /// Looks at the counters of the source, always the same one.
  void look(const EventSource& source);
  /// Whether a live source has dropped events between the last two looks.
  bool overflows() const { return overflows_; }

 private:
  void look_at_drops(const EventSource& source);
  void look_at_messages(const EventSource& source);

  RateLimitedLog& log_;
  std::int64_t drops_told_ = 0;
  std::int64_t messages_told_ = 0;
  std::int64_t overflow_seen_ = 0;
  bool overflows_ = false;
};

}  // namespace puck
