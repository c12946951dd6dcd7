#include <set>

#include "tools/doctor/checks.h"
#include "tools/doctor/commands.h"

namespace puck {
namespace {

constexpr const char* kFirewall = "firewall";
constexpr std::size_t kMostShown = 5;

}  // namespace

Findings check_firewall(const Facts& facts) {
  if (!facts.firewall) {
    return {{Verdict::kNote, kFirewall, "the packet filter's rules cannot be read by this user",
             as_root(facts, {"nft list ruleset"})}};
  }
  if (facts.firewall->empty()) {
    return {{Verdict::kOk, kFirewall, "no rule of the packet filter drops datagrams to the port"}};
  }
  // A rule may not apply to our datagrams; the self-test shows whether they arrive.
  const SelfTest& test = facts.self_test;
  const bool drops_ours = test.sent > 0 && test.came_back < test.sent;
  std::string text = drops_ours ? "rules that drop datagrams to the port:"
                                : "rules that may drop datagrams to the port:";
  std::vector<std::string> accepts;
  std::set<std::string> seen;
  std::size_t shown = 0;
  for (const FirewallDrop& drop : *facts.firewall) {
    if (shown++ < kMostShown) text += (shown == 1 ? " " : "; ") + drop.where + ": " + drop.rule;
    if (seen.insert(drop.accept).second) accepts.push_back(drop.accept);
  }
  if (shown > kMostShown) text += "; and " + std::to_string(shown - kMostShown) + " more";
  if (!drops_ours) return {{Verdict::kNote, kFirewall, text}};
  return {{Verdict::kWrong, kFirewall, text, as_root(facts, accepts)}};
}

}  // namespace puck
