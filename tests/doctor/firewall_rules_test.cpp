#include "tools/doctor/firewall_rules.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr int kPort = 7667;

std::string chain(const std::string& name, const std::string& base = "") {
  return R"({"chain": {"family": "inet", "table": "filter", "handle": 1, "name": ")" + name + '"' +
         base + "}}";
}
std::string hook(const std::string& name, const std::string& policy = "accept") {
  return R"(, "type": "filter", "prio": 0, "hook": ")" + name + R"(", "policy": ")" + policy + '"';
}
std::string rule(const std::string& of_chain, const std::string& expressions) {
  return R"({"rule": {"family": "inet", "table": "filter", "handle": 2, "chain": ")" + of_chain +
         R"(", "expr": [)" + expressions + "]}}";
}
std::string match(const std::string& left, const std::string& right, const char* op = "==") {
  return R"({"match": {"op": ")" + std::string(op) + R"(", "left": )" + left + R"(, "right": )" +
         right + "}}, ";
}
std::string payload(const std::string& protocol, const std::string& field, const std::string& right,
                    const char* op = "==") {
  return match(R"({"payload": {"protocol": ")" + protocol + R"(", "field": ")" + field + R"("}})",
               right, op);
}

const std::string kDrop = R"({"drop": null})";
const std::string kAccept = R"({"accept": null})";
const std::string kCounter = R"({"counter": {"packets": 0, "bytes": 0}}, )";
const std::string kToUs = payload("udp", "dport", "7667");

// Drops in the output of `nft -j list ruleset` with these chains and rules.
std::vector<FirewallDrop> drops_in(const std::vector<std::string>& entries) {
  std::string listing = R"({"nftables": [{"metainfo": {"json_schema_version": 1}})";
  for (const std::string& entry : entries) listing += ", " + entry;
  const auto drops = find_nft_drops(listing + "]}", kPort);
  REQUIRE(drops.has_value());
  return *drops;
}
std::vector<FirewallDrop> drops_of_input(const std::vector<std::string>& rules,
                                         const std::string& policy = "accept") {
  std::vector<std::string> entries{chain("input", hook("input", policy))};
  for (const std::string& expressions : rules) entries.push_back(rule("input", expressions));
  return drops_in(entries);
}

}  // namespace

TEST_CASE("an empty filter and one that accepts drop nothing") {
  CHECK(drops_in({}).empty());
  CHECK(drops_of_input({}).empty());
  CHECK(drops_of_input({kToUs + kAccept}).empty());
}

TEST_CASE("a policy and a rule that drop are found, with a rule that opens the port") {
  const std::string established =
      match(R"({"ct": {"key": "state"}})", R"(["established", "related"])", "in") + kAccept;
  const auto policy = drops_of_input({established}, "drop");
  REQUIRE(policy.size() == 1);
  CHECK(policy[0].where == "inet filter input");
  CHECK(policy[0].rule == "policy drop");
  CHECK(policy[0].accept == "nft insert rule inet filter input udp dport 7667 accept");
  const std::string ours = R"({"prefix": {"addr": "10.0.0.0", "len": 8}})";
  const auto drops = drops_of_input({payload("ip", "saddr", ours) + kToUs + kCounter + kDrop});
  REQUIRE(drops.size() == 1);
  CHECK(drops[0].rule == "ip saddr 10.0.0.0/8 udp dport 7667 counter drop");
  const std::string random = R"({"numgen": {"mode": "random", "mod": 100, "offset": 0}})";
  const std::string udp = match(R"({"meta": {"key": "l4proto"}})", R"("udp")");
  CHECK(drops_of_input({udp + match(random, "1", "<") + kDrop}).size() == 1);
  CHECK(drops_of_input({payload("ip", "daddr", ours) + R"({"reject": {"type": "icmp"}})"}).size() ==
        1);
}

TEST_CASE("rules for other ports, protocols and IP versions do not apply") {
  CHECK(
      drops_of_input({payload("tcp", "dport", "22") + kDrop, payload("udp", "dport", "53") + kDrop,
                      payload("udp", "dport", R"({"range": [53, 60]})") + kDrop,
                      payload("udp", "dport", "7667", "!=") + kDrop,
                      match(R"({"meta": {"key": "l4proto"}})", R"("tcp")") + kDrop,
                      match(R"({"ct": {"key": "state"}})", R"("invalid")", "in") + kDrop,
                      payload("ip6", "saddr", R"("::1")") + kDrop})
          .empty());
  CHECK(find_nft_drops(R"({"nftables": [{"chain": {"family": "ip6", "table": "filter",
                           "name": "input", "hook": "input", "policy": "drop"}}]})",
                       kPort)
            ->empty());
}

TEST_CASE("the port may be in a set or a range, and a named set may hold it") {
  const std::string set = R"({"set": [53, {"range": [7000, 8000]}]})";
  CHECK(drops_of_input({payload("udp", "dport", set) + kDrop}).size() == 1);
  CHECK(drops_of_input({payload("udp", "dport", set) + kAccept}, "drop").empty());
  CHECK(drops_of_input({payload("udp", "dport", R"({"set": [53, 67]})") + kDrop}).empty());
  CHECK(drops_of_input({payload("udp", "dport", R"("@closed")") + kDrop}).size() == 1);
  CHECK(drops_of_input({payload("udp", "dport", R"("@open")") + kAccept}, "drop").size() == 1);
  const std::string both = match(R"({"meta": {"key": "l4proto"}})", R"({"set": ["tcp", "udp"]})");
  CHECK(drops_of_input({both + payload("th", "dport", "7667") + kDrop}).size() == 1);
}

TEST_CASE("a rule that accepts the port from all senders overrides later rules only") {
  CHECK(drops_of_input({kToUs + kCounter + kAccept, kToUs + kDrop}, "drop").empty());
  CHECK(drops_of_input({kToUs + kDrop, kToUs + kAccept}).size() == 1);
  const std::string from_one = payload("ip", "saddr", R"("10.0.0.1")");
  CHECK(drops_of_input({from_one + kToUs + kAccept}, "drop").size() == 1);
  CHECK(drops_of_input({kToUs + from_one + kAccept}, "drop").size() == 1);
  const std::string unknown = R"({"xt": {"type": "match", "name": "recent"}}, )";
  CHECK(drops_of_input({kToUs + unknown + kAccept}, "drop").size() == 1);
}

TEST_CASE("forward chains do not apply, jump targets of input rules do") {
  const auto drops = drops_in(
      {chain("FORWARD", hook("forward", "drop")), chain("INPUT", hook("input")), chain("guard"),
       chain("unused"), rule("INPUT", kCounter + R"({"jump": {"target": "guard"}})"),
       rule("guard", kToUs + kDrop), rule("guard", R"({"jump": {"target": "guard"}})"),
       rule("unused", kDrop)});
  REQUIRE(drops.size() == 1);
  CHECK(drops[0].where == "inet filter guard");
  CHECK(drops[0].accept == "nft insert rule inet filter INPUT udp dport 7667 accept");
}

TEST_CASE("the output of iptables is parsed as well") {
  CHECK(find_iptables_drops("-P INPUT ACCEPT\n-P FORWARD DROP\n-P OUTPUT ACCEPT\n", kPort).empty());
  const auto drops = find_iptables_drops(
      "-P INPUT DROP\n-P OUTPUT ACCEPT\n-A INPUT -p tcp -m tcp --dport 22 -j DROP\n"
      "-A INPUT -s 10.0.0.9/32 -p udp -m udp --dport 7667 -j DROP\n",
      kPort);
  REQUIRE(drops.size() == 2);
  CHECK(drops[0].where == "iptables INPUT");
  CHECK(drops[0].accept == "iptables -I INPUT -p udp --dport 7667 -j ACCEPT");
  CHECK(find_iptables_drops("-P INPUT DROP\n-A INPUT -p udp -m udp --dport 7667 -j ACCEPT\n", kPort)
            .empty());
}

TEST_CASE("garbage is no rule") {
  for (const std::string_view text : {"}", "chain", "", "[]", R"({"nftables": [1]})",
                                      R"({"nftables": [{"chain": {}}]})", "-A", "-P X"}) {
    const auto drops = find_nft_drops(text, kPort);
    CHECK((!drops || drops->empty()));
    CHECK(find_iptables_drops(text, kPort).empty());
  }
}

}  // namespace puck
