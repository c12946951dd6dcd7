#include <algorithm>

#include "tools/doctor/checks.h"
#include "tools/doctor/commands.h"

namespace puck {
namespace {

constexpr const char* kRoute = "route";

/// The interface that most likely leads to other machines: one that is up and has an address before
/// others.
const NetworkInterface* best_way_out(const Facts& facts) {
  const auto rank = [](const NetworkInterface& interface) {
    return 4 * interface.is_up + 2 * !interface.addresses.empty() + interface.has_link;
  };
  const NetworkInterface* best = nullptr;
  for (const NetworkInterface& interface : facts.interfaces) {
    if (interface.is_loopback || !interface.can_multicast) continue;
    if (best == nullptr || rank(interface) > rank(*best)) best = &interface;
  }
  return best;
}

std::string route_over(const Facts& facts, const NetworkInterface& interface) {
  std::vector<std::string> commands;
  if (!interface.is_up) commands.push_back("ip link set " + interface.name + " up");
  commands.push_back("ip route replace 224.0.0.0/4 dev " + interface.name);
  return as_root(facts, commands);
}

std::string route_over_loopback(const Facts& facts) {
  return as_root(facts, {"ip link set lo up", "ip route replace 224.0.0.0/4 dev lo"});
}

Findings no_route(const Facts& facts, const std::string& why) {
  const NetworkInterface* way = best_way_out(facts);
  const bool can_leave = way != nullptr && (way->is_up || facts.url.ttl > 0);
  std::string text = "no route to the multicast group " + facts.url.group + " (" + why + ")";
  if (!can_leave && facts.url.ttl > 0) text += ", and no interface but lo; over lo for this host";
  return {{Verdict::kWrong, kRoute, text,
           can_leave ? route_over(facts, *way) : route_over_loopback(facts)}};
}

Findings loopback_only(const Facts& facts) {
  const std::string text =
      "multicast to " + facts.url.group +
      " goes to lo: nothing leaves this host, although ttl=" + std::to_string(facts.url.ttl);
  const NetworkInterface* way = best_way_out(facts);
  if (way != nullptr) return {{Verdict::kWrong, kRoute, text, route_over(facts, *way)}};
  LcmUrl this_host = facts.url;
  this_host.ttl = 0;
  return {{Verdict::kWrong, kRoute,
           text + ". There is no other interface; for this host alone, say so",
           lcm_url_option(this_host)}};
}

}  // namespace

Findings check_route(const Facts& facts) {
  if (const auto* why = std::get_if<std::string>(&facts.route)) return no_route(facts, *why);
  const NetworkInterface* interface = facts.group_interface();
  if (interface != nullptr && interface->is_loopback && facts.url.ttl > 0) {
    return loopback_only(facts);
  }
  const auto& route = std::get<KernelRoute>(facts.route);
  return {{Verdict::kOk, kRoute,
           "multicast to " + facts.url.group + " goes by " + route.interface +
               (route.source.empty() ? "" : ", from " + route.source)}};
}

}  // namespace puck
