#include "services/launch/bus_watch.h"

#include <spdlog/fmt/fmt.h>

namespace puck {

void BusWatch::poll() {
  if (std::chrono::steady_clock::now() >= due_) look();
}

void BusWatch::look() {
  constexpr std::chrono::seconds kPeriod{1};
  due_ = std::chrono::steady_clock::now() + kPeriod;
  for (const Channel channel : kAllChannels) {
    look_at(bus_.counters(channel), seen_[static_cast<std::size_t>(channel)]);
  }
  look_at(bus_.unknown_channels(), unknown_seen_);
  look_at_network();
}

void BusWatch::look_at(const ChannelCounters& now, ChannelCounters& before) {
  const auto warn = [&](std::int64_t count, const char* what, const std::string& last) {
    if (count > 0)
      log_.warn(
          fmt::format("{}: {} {}{}{}", now.channel, count, what, last.empty() ? "" : ": ", last));
  };
  warn(now.rejected - before.rejected + now.oversize - before.oversize,
       "malformed messages dropped, the last", now.last_rejection);
  warn(now.unauthenticated - before.unauthenticated, "messages without our key dropped, the last",
       now.last_rejection);
  warn(now.arrivals.lost - before.arrivals.lost, "messages lost", "");
  warn(now.handler_failures - before.handler_failures,
       "messages dropped because of an error in this service, the last", now.last_handler_failure);
  warn(now.publish_failures - before.publish_failures, "messages not sent, the last",
       now.last_publish_failure);
  before = now;
}

void BusWatch::look_at_network() {
  TransportCounters now = bus_.network_counters();
  if (const auto malformed = now.malformed - network_seen_.malformed; malformed > 0) {
    log_.warn(fmt::format("{} malformed datagrams on PUCK channels dropped, the last: {}",
                          malformed, now.last_malformed));
  }
  if (now.rejoined > network_seen_.rejoined) log_.warn("the network is back: receiving again");
  // A foreign sender is logged once; STATUS counts its datagrams.
  for (std::size_t i = network_seen_.foreign_traffic.size(); i < now.foreign_traffic.size(); ++i) {
    const ForeignTraffic& stranger = now.foreign_traffic[i];
    log_.warn(fmt::format("foreign datagrams on this group and port: {} from {}", stranger.what,
                          to_string(stranger.sender)));
  }
  network_seen_ = std::move(now);
}

void BusWatch::report_totals(StatusReport& report) const {
  const TransportCounters network = bus_.network_counters();
  ChannelCounters sum;
  sum.rejected = network.malformed;
  sum.unauthenticated = bus_.unknown_channels().unauthenticated;
  for (const Channel channel : kAllChannels) {
    const ChannelCounters counters = bus_.counters(channel);
    sum.arrivals.received += counters.arrivals.received;
    sum.arrivals.lost += counters.arrivals.lost;
    sum.arrivals.late += counters.arrivals.late;
    sum.arrivals.duplicates += counters.arrivals.duplicates;
    sum.rejected += counters.rejected + counters.oversize;
    sum.oversize += counters.oversize;
    sum.unauthenticated += counters.unauthenticated;
    sum.handler_failures += counters.handler_failures;
    sum.publish_failures += counters.publish_failures;
  }
  const auto add = [&](const char* name, std::int64_t value) {
    report.counters.emplace_back(name, value);
  };
  add("messages_received", sum.arrivals.received);
  add("messages_lost", sum.arrivals.lost);
  add("messages_late", sum.arrivals.late);
  add("messages_rejected", sum.rejected);
  add("handler_failures", sum.handler_failures);
  add("publish_failures", sum.publish_failures);
  report.add_unless_zero("messages_duplicate", sum.arrivals.duplicates);
  report.add_unless_zero("messages_oversize", sum.oversize);
  report.add_unless_zero("messages_unauthenticated", sum.unauthenticated);
  report.add_unless_zero("messages_foreign", network.foreign);
  report.add_unless_zero("network_rejoined", network.rejoined);
}

void BusWatch::report_channels(StatusReport& report) const {
  for (const Channel channel : kAllChannels) {
    report_channel(channel, bus_.counters(channel), report);
  }
}

void BusWatch::report_channel(Channel channel, const ChannelCounters& counters,
                              StatusReport& report) {
  const auto add = [&](const char* name, std::int64_t value) {
    if (value > 0) report.counters.emplace_back(std::string(base_name(channel)) + name, value);
  };
  add(".received", counters.arrivals.received);
  add(".lost", counters.arrivals.lost);
  add(".late", counters.arrivals.late);
  add(".duplicate", counters.arrivals.duplicates);
  add(".rejected", counters.rejected);
  add(".oversize", counters.oversize);
  add(".unauthenticated", counters.unauthenticated);
  if (counters.arrivals.sessions > 1) add(".publishers", counters.arrivals.sessions);
}

}  // namespace puck
