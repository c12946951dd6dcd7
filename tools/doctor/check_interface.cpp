#include "tools/doctor/checks.h"
#include "tools/doctor/commands.h"

namespace puck {
namespace {

constexpr const char* kInterface = "interface";

}  // namespace

Findings check_interface(const Facts& facts) {
  const NetworkInterface* interface = facts.group_interface();
  if (interface == nullptr) {
    return {{Verdict::kNote, kInterface, "not checked: the group has no interface"}};
  }
  const std::string& name = interface->name;
  const auto wrong = [&](const std::string& text, const std::string& mend) {
    return Findings{{Verdict::kWrong, kInterface, name + " " + text, mend}};
  };
  if (!interface->is_up) {
    return wrong("is switched off", as_root(facts, {"ip link set " + name + " up"}));
  }
  if (!interface->is_loopback && !interface->can_multicast) {
    return wrong("does not support multicast",
                 as_root(facts, {"ip link set " + name + " multicast on"}));
  }
  if (!interface->has_link) {
    return wrong("has no link: no cable, or the other end is off; look at both ends",
                 "ip link show " + name);
  }
  if (interface->addresses.empty()) {
    return wrong("has no IPv4 address", as_root(facts, {"dhclient " + name}));
  }
  return {{Verdict::kOk, kInterface,
           name + " is up, " + (interface->is_loopback ? "loopback" : "multicast") + ", " +
               interface->addresses.front()}};
}

}  // namespace puck
