#include "common/messaging/clock_offsets.h"

#include <algorithm>
#include <cstdlib>

namespace puck {
namespace {

// Two clocks drift apart by less than 100 µs a second.
constexpr std::int64_t kUsPerUsOfDrift = 10'000;
// Tolerance for a negative round trip, from the clocks' drift while the answer waited.
constexpr std::int64_t kRounding_us = 1'000;
// Beyond this no sum of two times overflows.
constexpr std::int64_t kLatest_utime = std::int64_t{1} << 60;

}  // namespace

std::int64_t ClockOffsets::Exchange::uncertainty_at(std::int64_t monotonic_us) const {
  return uncertainty_us + std::abs(monotonic_us - heard_us) / kUsPerUsOfDrift;
}

bool ClockOffsets::Exchange::agrees_with(const Exchange& other) const {
  return std::abs(ahead_us - other.ahead_us) <=
         uncertainty_us + other.uncertainty_at(heard_us) + kRounding_us;
}

void ClockOffsets::Clock::add(const Exchange& exchange) {
  heard_us = exchange.heard_us;
  if (exchanges.empty() || exchange.agrees_with(best)) {
    if (doubter && !exchange.agrees_with(*doubter)) doubter.reset();
    keep(exchange);
  } else if (doubter && exchange.agrees_with(*doubter)) {
    // Two exchanges agree: the other clock was set.
    exchanges.clear();
    next = 0;
    keep(*doubter);
    keep(exchange);
    doubter.reset();
  } else {
    doubter = exchange;
  }
}

void ClockOffsets::Clock::keep(const Exchange& exchange) {
  if (exchanges.size() < kExchanges) {
    exchanges.push_back(exchange);
  } else {
    exchanges[next] = exchange;
  }
  next = (next + 1) % kExchanges;
  best = *std::min_element(exchanges.begin(), exchanges.end(),
                           [&](const Exchange& a, const Exchange& b) {
                             return a.uncertainty_at(heard_us) < b.uncertainty_at(heard_us);
                           });
}

void ClockOffsets::ping(const HostNow& sent) {
  pings_[next_ping_] = sent;
  next_ping_ = (next_ping_ + 1) % kPings;
}

bool ClockOffsets::add(std::int64_t session, const ClockAnswer& answer) {
  if (answer.received_utime < 0 || answer.answered_utime < answer.received_utime ||
      answer.answered_utime > kLatest_utime) {
    return false;
  }
  const auto ping = std::find_if(pings_.begin(), pings_.end(), [&](const HostNow& sent) {
    return sent.utime == answer.ping_utime && sent.utime != 0;
  });
  if (ping == pings_.end()) return false;

  const std::int64_t away_us = answer.heard_monotonic_us - ping->monotonic_us;
  const std::int64_t waited_us = answer.answered_utime - answer.received_utime;
  if (away_us < 0 || waited_us > away_us + kRounding_us) return false;
  const std::int64_t round_trip_us = std::max<std::int64_t>(0, away_us - waited_us);
  Exchange exchange;
  exchange.ahead_us = answer.received_utime + waited_us / 2 - (ping->monotonic_us + away_us / 2);
  exchange.uncertainty_us = (round_trip_us + 1) / 2 + 1;
  exchange.heard_us = answer.heard_monotonic_us;
  clock_of(session).add(exchange);
  return true;
}

ClockOffsets::Clock& ClockOffsets::clock_of(std::int64_t session) {
  const auto known = std::find_if(clocks_.begin(), clocks_.end(),
                                  [&](const Clock& clock) { return clock.session == session; });
  if (known != clocks_.end()) return *known;
  if (clocks_.size() < kSessions) {
    clocks_.push_back({.session = session});
    return clocks_.back();
  }
  const auto longest_silent =
      std::min_element(clocks_.begin(), clocks_.end(),
                       [](const Clock& a, const Clock& b) { return a.heard_us < b.heard_us; });
  *longest_silent = {.session = session};
  return *longest_silent;
}

SenderClock ClockOffsets::offset_of(std::int64_t session, const HostNow& now) const {
  const auto known = std::find_if(clocks_.begin(), clocks_.end(),
                                  [&](const Clock& clock) { return clock.session == session; });
  if (known == clocks_.end()) return std::nullopt;
  const std::int64_t own_ahead_us = now.utime - now.monotonic_us;
  const std::int64_t ahead_us = known->best.ahead_us - own_ahead_us;
  const std::int64_t uncertainty_us = known->best.uncertainty_at(now.monotonic_us);
  // Clocks that agree within the uncertainty count as equal, as they are on one host, so that
  // latencies there have no measurement error. The measured difference adds to the uncertainty.
  if (std::abs(ahead_us) <= known->best.uncertainty_us) {
    return ClockOffset{0, uncertainty_us + std::abs(ahead_us)};
  }
  return ClockOffset{ahead_us, uncertainty_us};
}

}  // namespace puck
