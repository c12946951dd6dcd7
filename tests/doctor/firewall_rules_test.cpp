#include "tools/doctor/firewall_rules.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr int kPort = 7667;

std::vector<FirewallDrop> drops_of_input(const std::string& rules,
                                         const std::string& policy = "accept") {
  return find_nft_drops(
      "table inet filter {\n\tchain input {\n\t\ttype filter hook input priority "
      "filter; policy " +
          policy + ";\n" + rules + "\t}\n}\n",
      kPort);
}

}  // namespace

TEST_CASE("an empty filter and one that accepts drop nothing") {
  CHECK(find_nft_drops("", kPort).empty());
  CHECK(drops_of_input("").empty());
  CHECK(drops_of_input("\t\tudp dport 7667 accept\n").empty());
}

TEST_CASE("a policy and a rule that drop are found, with a rule that opens the port") {
  const auto policy = drops_of_input("\t\tct state established accept\n", "drop");
  REQUIRE(policy.size() == 1);
  CHECK(policy[0].where == "inet filter input");
  CHECK(policy[0].rule == "policy drop");
  CHECK(policy[0].accept == "nft insert rule inet filter input udp dport 7667 accept");
  const auto rule = drops_of_input("\t\tip saddr 10.0.0.0/8 udp dport 7667 counter drop\n");
  REQUIRE(rule.size() == 1);
  CHECK(rule[0].rule == "ip saddr 10.0.0.0/8 udp dport 7667 counter drop");
  CHECK(drops_of_input("\t\tmeta l4proto udp numgen random mod 100 < 1 drop\n").size() == 1);
  CHECK(drops_of_input("\t\tip daddr 224.0.0.0/4 reject\n").size() == 1);
}

TEST_CASE("rules for other ports and protocols do not apply") {
  CHECK(drops_of_input("\t\ttcp dport 22 drop\n\t\tudp dport 53 drop\n\t\tct state invalid drop\n"
                       "\t\tip6 saddr ::1 drop\n")
            .empty());
}

TEST_CASE("a rule that accepts the port from all senders overrides later rules only") {
  CHECK(drops_of_input("\t\tudp dport 7667 accept\n\t\tudp dport 7667 drop\n", "drop").empty());
  CHECK(drops_of_input("\t\tudp dport 7667 drop\n\t\tudp dport 7667 accept\n").size() == 1);
  CHECK(drops_of_input("\t\tip saddr 10.0.0.1 udp dport 7667 accept\n", "drop").size() == 1);
}

TEST_CASE("forward chains do not apply, jump targets of input rules do") {
  const std::string ruleset =
      "table ip filter {\n"
      "\tchain FORWARD {\n\t\ttype filter hook forward priority 0; policy drop;\n\t}\n"
      "\tchain INPUT {\n\t\ttype filter hook input priority 0; policy accept;\n"
      "\t\tcounter jump guard\n\t}\n"
      "\tchain guard {\n\t\tudp dport 7667 drop\n\t\tjump guard\n\t}\n"
      "\tchain unused {\n\t\tdrop\n\t}\n}\n";
  const auto drops = find_nft_drops(ruleset, kPort);
  REQUIRE(drops.size() == 1);
  CHECK(drops[0].where == "ip filter guard");
  CHECK(drops[0].accept == "nft insert rule ip filter INPUT udp dport 7667 accept");
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
  for (const std::string_view text :
       {"}", "chain", "table x\nchain\n}", "type hook", "-A", "-P X"}) {
    CHECK(find_nft_drops(text, kPort).empty());
    CHECK(find_iptables_drops(text, kPort).empty());
  }
}

}  // namespace puck
