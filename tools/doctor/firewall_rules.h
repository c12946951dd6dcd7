#pragma once

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

/// Such rules for UDP datagrams of `port` to or from this host, in the output of `nft list
/// ruleset`. Found by keywords, not by a model of the filter: hints for people.
std::vector<FirewallDrop> find_nft_drops(std::string_view ruleset, int port);

/// The same in the output of `iptables -S`.
std::vector<FirewallDrop> find_iptables_drops(std::string_view rules, int port);

}  // namespace puck
