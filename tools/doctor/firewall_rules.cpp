#include "tools/doctor/firewall_rules.h"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

namespace puck {
namespace {

using Json = nlohmann::json;
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
  if (has_any(rule, {"tcp", "icmp", "sctp", "INVALID"})) return false;
  const std::string wanted = after(rule, "--dport");
  const bool is_one_port =
      !wanted.empty() && wanted.find_first_not_of("0123456789") == std::string::npos;
  return !is_one_port || wanted == std::to_string(port);
}

/// A named set: its elements are not known.
bool is_named_set(const Json& value) { return value.dump().starts_with("\"@"); }

/// Whether a port or a word is the value of a match or one of its elements.
bool includes(const Json& value, const Json& wanted) {
  if (value.contains("set")) return includes(value["set"], wanted);
  if (value.contains("range")) {
    return value["range"].at(0) <= wanted && wanted <= value["range"].at(1);
  }
  if (!value.is_array()) return value == wanted;
  return std::any_of(value.begin(), value.end(),
                     [&](const Json& element) { return includes(element, wanted); });
}

/// "udp dport", "ip saddr", "l4proto", "state", …
std::string field_of(const Json& match) {
  for (const auto& [kind, left] : match.at("left").items()) {
    if (!left.contains("field")) return left.value("key", kind);
    return left.value("protocol", "") + " " + left.value("field", "");
  }
  return "";
}

/// False if the match cannot hold for a UDP datagram over IPv4 to the port.
bool may_hold(const Json& match, int port) {
  const std::string field = field_of(match);
  const Json& value = match.at("right");
  const bool is_equal = match.at("op") != "!=";
  if (is_named_set(value)) return true;
  if (field == "udp dport" || field == "th dport") return includes(value, port) == is_equal;
  if (field == "l4proto") return includes(value, "udp") == is_equal;
  if (field == "nfproto") return includes(value, "ipv4") == is_equal;
  if (field == "state") return value != "invalid";
  const std::string protocol = field.substr(0, field.find(' '));
  return protocol == field || std::set<std::string>{"udp", "th", "ip", "ether"}.contains(protocol);
}

/// A value as a person reads it: 7667, 1-1024, 10.0.0.0/8.
std::string text_of(const Json& value) {
  if (value.is_string()) return value;
  if (value.contains("range")) {
    return text_of(value["range"].at(0)) + "-" + text_of(value["range"].at(1));
  }
  if (value.contains("prefix")) {
    return text_of(value["prefix"].at("addr")) + "/" + text_of(value["prefix"].at("len"));
  }
  return value.dump();
}

/// Drops of a chain and of the chains that it jumps to, in the output of `nft -j list ruleset`.
class NftDrops {
 public:
  NftDrops(const Json& entries, const Json& base, int port) : entries_(entries), port_(port) {
    accept_ = "nft insert rule " + name_of(base, "name") + " udp dport " + std::to_string(port) +
              " accept";
    walk(base);
  }

  std::vector<FirewallDrop> found;

 private:
  /// "inet filter input": family, table, chain.
  static std::string name_of(const Json& of, const char* chain) {
    return of.at("family").get<std::string>() + " " + of.at("table").get<std::string>() + " " +
           of.at(chain).get<std::string>();
  }

  void walk(const Json& chain) {
    const std::string name = name_of(chain, "name");
    if (!visited_.insert(name).second) return;
    for (const Json& entry : entries_) {
      if (!entry.contains("rule") || name_of(entry["rule"], "chain") != name) continue;
      if (follow(entry["rule"].at("expr"), chain)) return;
    }
    if (chain.value("policy", "") == "drop") found.push_back({name, "policy drop", accept_});
  }

  /// Whether a rule of the chain ends it for all our datagrams.
  bool follow(const Json& rule, const Json& chain) {
    std::string text;
    std::string verdict;
    bool has_conditions = false;
    for (const Json& statement : rule) {
      if (!statement.is_object() || statement.empty()) continue;
      const std::string& kind = statement.begin().key();
      const Json& content = statement.begin().value();
      if (!text.empty()) text += " ";
      if (kind == "match") {
        if (!may_hold(content, port_)) return false;
        has_conditions = has_conditions || !field_of(content).ends_with(" dport") ||
                         is_named_set(content.at("right"));
        const std::string op = content.at("op");
        text += field_of(content) + (op == "==" || op == "in" ? " " : " " + op + " ") +
                text_of(content.at("right"));
        continue;
      }
      text += kind;
      if (kind == "drop" || kind == "reject" || kind == "accept") verdict = kind;
      has_conditions = has_conditions || (verdict.empty() && kind != "counter");
      if (kind == "jump" || kind == "goto") jump(content.at("target"), chain);
    }
    if (verdict == "accept") return !has_conditions;
    if (!verdict.empty()) found.push_back({name_of(chain, "name"), text, accept_});
    return false;
  }

  void jump(const Json& target, const Json& from) {
    for (const Json& entry : entries_) {
      if (!entry.contains("chain")) continue;
      const Json& chain = entry["chain"];
      if (chain.at("name") == target && chain.at("table") == from.at("table") &&
          chain.at("family") == from.at("family")) {
        walk(chain);
      }
    }
  }

  const Json& entries_;
  int port_;
  std::string accept_;
  std::set<std::string> visited_;
};

}  // namespace

std::optional<std::vector<FirewallDrop>> find_nft_drops(std::string_view ruleset, int port) {
  try {
    const Json listing = Json::parse(ruleset);
    const Json& entries = listing.at("nftables");
    const std::set<std::string> on_our_way{"input", "output", "prerouting", "ingress"};
    std::vector<FirewallDrop> drops;
    for (const Json& entry : entries) {
      if (!entry.contains("chain") || entry["chain"].at("family") == "ip6") continue;
      if (!on_our_way.contains(entry["chain"].value("hook", ""))) continue;
      const NftDrops its_drops(entries, entry["chain"], port);
      drops.insert(drops.end(), its_drops.found.begin(), its_drops.found.end());
    }
    return drops;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
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
