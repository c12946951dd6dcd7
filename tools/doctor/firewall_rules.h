#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace puck {

/// A rule or policy of the packet filter that may drop the bus's datagrams.
struct FirewallDrop {
  std::string where;   ///< "inet filter input"
  std::string rule;    ///< As listed by the packet filter.
  std::string accept;  ///< A command that accepts the bus's port before this rule.
};

/// Such rules for UDP datagrams of `port` over IPv4 to or from this host, in the output of `nft -j
/// list ruleset`. Conditions other than port and protocol count as fulfilled: hints for people.
/// Nothing if the output is something else.
std::optional<std::vector<FirewallDrop>> find_nft_drops(std::string_view ruleset, int port);

/// The same in the output of `iptables -S`, which has no JSON. Only read where nft is missing.
std::vector<FirewallDrop> find_iptables_drops(std::string_view rules, int port);

}  // namespace puck
