#include <algorithm>

#include "tools/doctor/checks.h"
#include "tools/doctor/commands.h"

namespace puck {
namespace {

constexpr const char* kReversePath = "reverse path";
constexpr int kStrict = 1;

int setting(const Facts& facts, const std::string& interface) {
  const auto found = facts.reverse_path_filter.find(interface);
  return found == facts.reverse_path_filter.end() ? 0 : found->second;
}

}  // namespace

Findings check_reverse_path(const Facts& facts) {
  const NetworkInterface* interface = facts.group_interface();
  if (interface == nullptr || !facts.before || !facts.after) {
    return {{Verdict::kNote, kReversePath, "not checked: the group has no interface"}};
  }
  const std::string& name = interface->name;
  const std::int64_t grown = facts.after->reverse_path_drops - facts.before->reverse_path_drops;
  if (grown > 0) {
    return {{Verdict::kWrong, kReversePath,
             std::to_string(grown) +
                 " datagrams were dropped while listening: the route back to their sender uses "
                 "another interface",
             as_root(facts, {"sysctl -w net.ipv4.conf.all.rp_filter=0 net.ipv4.conf." + name +
                             ".rp_filter=0"})}};
  }
  // The kernel uses the larger of the two.
  if (std::max(setting(facts, "all"), setting(facts, name)) == kStrict) {
    return {{Verdict::kOk, kReversePath,
             "strict on " + name + ": only hosts to which " + name +
                 " has the route are received; nothing was dropped while listening"}};
  }
  return {{Verdict::kOk, kReversePath, "not strict on " + name}};
}

}  // namespace puck
