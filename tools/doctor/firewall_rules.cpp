#include "tools/doctor/firewall_rules.h"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <set>
#include <sstream>

namespace puck {
namespace {

using Words = std::vector<std::string>;

Words words_of(const std::string& line) {
  std::istringstream stream(line);
  Words words;
  for (std::string word; stream >> word;) {
    while (!word.empty() && word.back() == ';') word.pop_back();
    words.push_back(word);
  }
  return words;
}

bool has_any(const Words& words, std::initializer_list<std::string_view> wanted) {
  return std::any_of(wanted.begin(), wanted.end(), [&](std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  });
}

std::string after(const Words& words, std::string_view word) {
  const auto found = std::find(words.begin(), words.end(), word);
  return found == words.end() || std::next(found) == words.end() ? "" : *std::next(found);
}

/// A rule for another port, protocol or IP version cannot match our datagrams.
bool may_meet(const Words& rule, int port) {
  if (has_any(rule, {"tcp", "icmp", "icmpv6", "ip6", "esp", "sctp", "invalid", "INVALID"})) {
    return false;
  }
  for (const std::string_view match : {"dport", "--dport"}) {
    const std::string wanted = after(rule, match);
    const bool is_one_port =
        !wanted.empty() && wanted.find_first_not_of("0123456789") == std::string::npos;
    if (is_one_port && wanted != std::to_string(port)) return false;
  }
  return true;
}

struct Chain {
  std::string name;  ///< "inet filter input": family, table, chain.
  std::string hook;  ///< Empty: reached from other chains only.
  std::vector<std::string> rules;
  bool drops_the_rest = false;
};

/// Parses the output of `nft list ruleset`.
std::vector<Chain> read_chains(std::string_view ruleset) {
  std::vector<Chain> chains;
  std::string table;
  bool in_chain = false;
  std::istringstream stream{std::string(ruleset)};
  for (std::string line; std::getline(stream, line);) {
    const Words words = words_of(line);
    if (words.empty()) continue;
    if (words[0] == "table" && words.size() >= 3) {
      table = words[1] + " " + words[2];
    } else if (words[0] == "chain" && words.size() >= 2) {
      chains.push_back({.name = table + " " + words[1]});
      in_chain = true;
    } else if (words[0] == "}") {
      in_chain = false;
    } else if (in_chain && words[0] == "type") {
      chains.back().hook = after(words, "hook");
      chains.back().drops_the_rest = after(words, "policy") == "drop";
    } else if (in_chain) {
      chains.back().rules.push_back(line.substr(line.find_first_not_of(" \t")));
    }
  }
  return chains;
}

/// Drops of a chain and of the chains that it jumps to.
class NftDrops {
 public:
  NftDrops(const std::vector<Chain>& chains, int port) : port_(port) {
    for (const Chain& chain : chains) by_name_[chain.name] = &chain;
  }

  std::vector<FirewallDrop> of(const Chain& base) {
    base_ = &base;
    visited_.clear();
    drops_.clear();
    walk(base);
    return drops_;
  }

 private:
  void walk(const Chain& chain) {
    if (!visited_.insert(chain.name).second) return;
    const std::string table = chain.name.substr(0, chain.name.rfind(' ') + 1);
    for (const std::string& rule : chain.rules) {
      const Words words = words_of(rule);
      if (!may_meet(words, port_)) continue;
      // An accept for the bus's port ends the chain for our datagrams.
      if (accepts_our_port(words)) return;
      if (has_any(words, {"drop", "reject"})) add(chain, rule);
      for (const std::string_view verb : {"jump", "goto"}) {
        const auto next = by_name_.find(table + after(words, verb));
        if (next != by_name_.end()) walk(*next->second);
      }
    }
    if (chain.drops_the_rest) add(chain, "policy drop");
  }

  bool accepts_our_port(const Words& rule) const {
    return rule.size() >= 3 && rule[0] == "udp" && rule[1] == "dport" &&
           rule[2] == std::to_string(port_) && rule.back() == "accept";
  }

  void add(const Chain& chain, const std::string& rule) {
    drops_.push_back(
        {chain.name, rule,
         "nft insert rule " + base_->name + " udp dport " + std::to_string(port_) + " accept"});
  }

  int port_;
  std::map<std::string, const Chain*> by_name_;
  const Chain* base_ = nullptr;
  std::set<std::string> visited_;
  std::vector<FirewallDrop> drops_;
};

}  // namespace

std::vector<FirewallDrop> find_nft_drops(std::string_view ruleset, int port) {
  const std::vector<Chain> chains = read_chains(ruleset);
  NftDrops finder(chains, port);
  std::vector<FirewallDrop> drops;
  for (const Chain& chain : chains) {
    const bool is_on_our_way = chain.hook == "input" || chain.hook == "output" ||
                               chain.hook == "prerouting" || chain.hook == "ingress";
    if (!is_on_our_way) continue;
    const auto its_drops = finder.of(chain);
    drops.insert(drops.end(), its_drops.begin(), its_drops.end());
  }
  return drops;
}

std::vector<FirewallDrop> find_iptables_drops(std::string_view rules, int port) {
  std::vector<FirewallDrop> drops;
  std::set<std::string> accepting;  // Chains with an accept for the port so far.
  std::map<std::string, std::string> dropping_policies;
  std::istringstream stream{std::string(rules)};
  const auto accept = [&](const std::string& chain) {
    return "iptables -I " + chain + " -p udp --dport " + std::to_string(port) + " -j ACCEPT";
  };
  for (std::string line; std::getline(stream, line);) {
    const Words words = words_of(line);
    if (words.size() < 3 || (words[1] != "INPUT" && words[1] != "OUTPUT")) continue;
    const std::string& chain = words[1];
    if (words[0] == "-P") {
      if (words[2] == "DROP") dropping_policies[chain] = line;
      continue;
    }
    if (words[0] != "-A" || !may_meet(words, port)) continue;
    const std::string verdict = after(words, "-j");
    if (verdict == "ACCEPT" && after(words, "--dport") == std::to_string(port)) {
      accepting.insert(chain);
    } else if ((verdict == "DROP" || verdict == "REJECT") && !accepting.contains(chain)) {
      drops.push_back({"iptables " + chain, line, accept(chain)});
    }
  }
  for (const auto& [chain, policy] : dropping_policies) {
    if (!accepting.contains(chain)) drops.push_back({"iptables " + chain, policy, accept(chain)});
  }
  return drops;
}

}  // namespace puck
