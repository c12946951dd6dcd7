#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace puck {

/// A rule or policy of the packet filter that may drop the bus's datagrams.
struct FirewallDrop {
  std::string where;   ///< "inet filter input"
  std::string rule;    ///< As the filter lists it.
  std::string accept;  ///< The command that lets the bus's port through before it.
};

/// Those in what `nft list ruleset` prints that meet what comes to or leaves this host on UDP
/// `port`. By their words, not by a model of the filter: hints for a person.
std::vector<FirewallDrop> find_nft_drops(std::string_view ruleset, int port);

/// The same in what `iptables -S` prints.
std::vector<FirewallDrop> find_iptables_drops(std::string_view rules, int port);

}  // namespace puck
