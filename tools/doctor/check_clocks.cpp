#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "tools/doctor/checks.h"
#include "tools/doctor/live_services.h"

namespace puck {
namespace {

constexpr const char* kClocks = "clocks";
// Far above the error of NTP. The services correct for any offset; the times in the logs of two
// hosts are not corrected.
constexpr std::int64_t kMostApart_us = 100'000;

std::string in_milliseconds(std::int64_t time_us) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f ms", static_cast<double>(std::llabs(time_us)) * 1e-3);
  return text;
}

std::string set_clock(const std::string& address) {
  return "ssh " + address + " sudo timedatectl set-ntp true";
}

Finding measured(const std::string& address, const HostClock& offset) {
  const bool is_apart = std::llabs(offset.offset_us) - offset.within_us > kMostApart_us;
  const std::string text = "the clock of " + offset.host + " (" + address + ") is " +
                           in_milliseconds(offset.offset_us) +
                           (offset.offset_us >= 0 ? " ahead" : " behind") + ", to within " +
                           in_milliseconds(offset.within_us);
  if (!is_apart) return {Verdict::kOk, kClocks, text};
  return {Verdict::kNote, kClocks,
          text + "; the services correct for it, times in logs are not corrected",
          set_clock(address)};
}

/// Without a pong there is one bound: a message cannot arrive before it was sent.
Finding bounded(const std::string& address, const HeardService& service) {
  const std::string host = "the clock of " + service.status.host + " (" + address + ")";
  if (service.least_age_us < -kMostApart_us) {
    return {Verdict::kNote, kClocks,
            host + " is at least " + in_milliseconds(service.least_age_us) + " ahead",
            set_clock(address)};
  }
  if (service.least_age_us < 0) {
    return {Verdict::kNote, kClocks,
            host + " is at least " + in_milliseconds(service.least_age_us) +
                " ahead; by how much is unknown, as no pong came"};
  }
  return {Verdict::kNote, kClocks,
          host + " is at most " + in_milliseconds(service.least_age_us) +
              " behind; how far ahead is unknown, as no pong came"};
}

}  // namespace

Findings check_clocks(const Facts& facts) {
  Findings findings;
  for (const auto& [address, offset] : facts.clock_offsets) {
    if (!facts.is_own_address(address)) findings.push_back(measured(address, offset));
  }
  // The service with the tightest bound, for each other host.
  std::map<std::string, const HeardService*> unanswered;
  for (const HeardService* service : live_services(facts)) {
    const std::string& address = service->source.address;
    if (facts.is_own_address(address) || facts.clock_offsets.contains(address)) continue;
    const HeardService*& best = unanswered[address];
    if (best == nullptr || service->least_age_us < best->least_age_us) best = service;
  }
  for (const auto& [address, service] : unanswered) {
    findings.push_back(bounded(address, *service));
  }
  if (findings.empty()) {
    findings.push_back({Verdict::kOk, kClocks, "no other host is heard, so there is one clock"});
  }
  return findings;
}

}  // namespace puck
