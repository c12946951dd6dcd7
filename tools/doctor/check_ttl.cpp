#include <algorithm>

#include "tools/doctor/checks.h"
#include "tools/doctor/commands.h"

namespace puck {
namespace {

constexpr const char* kTtl = "ttl";

LcmUrl with_ttl_1(LcmUrl url) {
  url.ttl = 1;
  return url;
}

/// A sender of PUCK messages on another host.
std::string remote_sender(const Facts& facts) {
  for (const auto& [source, sender] : facts.traffic.senders()) {
    if (sender.ours > 0 && !facts.is_own_address(source.address)) return source.address;
  }
  return {};
}

/// Local programs whose datagrams stay on this host.
std::string senders_without_ttl(const Facts& facts) {
  std::string names;
  for (const auto& [source, sender] : facts.traffic.senders()) {
    if (sender.ours == 0 || sender.ttl != 0 || !facts.is_own_address(source.address)) continue;
    const auto known = facts.local_senders.find(source);
    if (!names.empty()) names += ", ";
    names += known != facts.local_senders.end() ? to_string(known->second)
                                                : "port " + std::to_string(source.port);
  }
  return names;
}

Findings stays_here(const Facts& facts) {
  const std::string mend = lcm_url_option(with_ttl_1(facts.url));
  const std::string remote = remote_sender(facts);
  if (!remote.empty()) {
    return {{Verdict::kWrong, kTtl,
             "ttl=0: messages of this host stay on it, but " + remote +
                 " is heard, so the bus spans machines; start the services here with",
             mend}};
  }
  return {{Verdict::kNote, kTtl,
           "ttl=0: this host only. No other machine or container hears anything; if they should, "
           "start every service with",
           mend}};
}

}  // namespace

Findings check_ttl(const Facts& facts) {
  if (facts.url.ttl == 0) return stays_here(facts);
  const std::string names = senders_without_ttl(facts);
  if (!names.empty()) {
    return {{Verdict::kWrong, kTtl,
             "sent with ttl=0, so no other machine hears it: " + names + "; start again with",
             lcm_url_option(facts.url)}};
  }
  return {{Verdict::kOk, kTtl,
           "ttl=" + std::to_string(facts.url.ttl) +
               (facts.url.ttl == 1 ? ": reaches the network that this host is on"
                                   : ": crosses routers that forward multicast")}};
}

}  // namespace puck
