#include "services/launch/bus_watch.h"

namespace puck {

void BusWatch::poll() {
  if (std::chrono::steady_clock::now() >= due_) look();
}

void BusWatch::look() {
  constexpr std::chrono::seconds kPeriod{1};
  due_ = std::chrono::steady_clock::now() + kPeriod;
  for (const Channel channel : kAllChannels) look_at(channel);
}

void BusWatch::look_at(Channel channel) {
  const ChannelCounters now = bus_.counters(channel);
  ChannelCounters& before = seen_[static_cast<std::size_t>(channel)];
  const auto warn = [&](std::int64_t count, const char* what, const std::string& last) {
    if (count > 0)
      log_.warn("{}: {} {}{}{}", now.channel, count, what, last.empty() ? "" : ": ", last);
  };
  warn(now.rejected - before.rejected, "malformed messages dropped, the last", now.last_rejection);
  warn(now.arrivals.lost - before.arrivals.lost, "messages lost", "");
  warn(now.handler_failures - before.handler_failures, "messages not dealt with, the last",
       now.last_handler_failure);
  warn(now.publish_failures - before.publish_failures, "messages not sent, the last",
       now.last_publish_failure);
  before = now;
}

void BusWatch::report(StatusReport& report) const {
  std::int64_t rejected = 0;
  std::int64_t lost = 0;
  std::int64_t late = 0;
  std::int64_t handler_failures = 0;
  std::int64_t publish_failures = 0;
  for (const Channel channel : kAllChannels) {
    const ChannelCounters counters = bus_.counters(channel);
    rejected += counters.rejected;
    lost += counters.arrivals.lost;
    late += counters.arrivals.late + counters.arrivals.duplicates;
    handler_failures += counters.handler_failures;
    publish_failures += counters.publish_failures;
  }
  report.counters.emplace_back("messages_rejected", rejected);
  report.counters.emplace_back("messages_lost", lost);
  report.counters.emplace_back("messages_late", late);
  report.counters.emplace_back("handler_failures", handler_failures);
  report.counters.emplace_back("publish_failures", publish_failures);
}

}  // namespace puck
