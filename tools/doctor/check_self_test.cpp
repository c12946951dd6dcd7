#include "tools/doctor/checks.h"
#include "tools/doctor/commands.h"

namespace puck {
namespace {

constexpr const char* kSelfTest = "self-test";

}  // namespace

Findings check_self_test(const Facts& facts) {
  const SelfTest& test = facts.self_test;
  if (std::holds_alternative<std::string>(facts.route)) {
    return {{Verdict::kNote, kSelfTest, "not done: there is no route"}};
  }
  if (!test.problem.empty()) {
    std::string mend;
    if (!facts.port_users.empty()) {
      mend = as_root(facts, {"kill " + std::to_string(facts.port_users.front().program.pid)});
    }
    return {{Verdict::kWrong, kSelfTest, "not done: " + test.problem, mend}};
  }
  const std::string came = std::to_string(test.came_back) + " of " + std::to_string(test.sent) +
                           " datagrams to " + facts.url.group + ":" +
                           std::to_string(facts.url.port) + " came back";
  if (test.sent > 0 && test.came_back == test.sent) return {{Verdict::kOk, kSelfTest, came}};
  if (test.came_back > 0) {
    return {{Verdict::kWrong, kSelfTest, came + ": datagrams are lost on this very host",
             "nft list ruleset"}};
  }
  const NetworkInterface* interface = facts.group_interface();
  const bool may_be_filter = facts.firewall && !facts.firewall->empty();
  if (may_be_filter || interface == nullptr) {
    return {{Verdict::kWrong, kSelfTest, came, may_be_filter ? "" : "ip route show"}};
  }
  return {{Verdict::kWrong, kSelfTest, came + "; look for a packet filter",
           as_root(facts, {"nft list ruleset"})}};
}

}  // namespace puck
