#include "tools/doctor/checks.h"
#include "tools/doctor/commands.h"

namespace puck {
namespace {

constexpr const char* kMembership = "membership";

std::string names_of(const Facts& facts) {
  std::string names;
  for (const PortUser& user : facts.port_users) {
    if (!names.empty()) names += ", ";
    names += to_string(user.program);
  }
  return names.empty() ? "a program of another user" : names;
}

/// A service manager or the user restarts them.
std::string end_all(const Facts& facts) {
  std::string pids;
  for (const PortUser& user : facts.port_users) pids += " " + std::to_string(user.program.pid);
  return pids.empty() ? "" : as_root(facts, {"kill" + pids});
}

}  // namespace

Findings check_membership(const Facts& facts) {
  const NetworkInterface* interface = facts.group_interface();
  if (interface == nullptr) {
    return {{Verdict::kNote, kMembership, "not checked: the group has no interface"}};
  }
  const std::string& group = facts.url.group;
  int here = 0;
  std::string elsewhere;
  for (const GroupMembership& membership : facts.memberships) {
    if (membership.group != group) continue;
    if (membership.interface == interface->name) {
      here = membership.users;
    } else {
      elsewhere = membership.interface;
    }
  }
  if (facts.sockets_at_port == 0) {
    return {{Verdict::kOk, kMembership, "no other program on this host listens on the port"}};
  }
  // The kernel counts members of the group on any port: fewer members than sockets on our port is a
  // fault, more proves nothing.
  const std::string counts = std::to_string(facts.sockets_at_port) +
                             " sockets listen at the port, " + std::to_string(here) +
                             " joined the group on " + interface->name;
  if (here >= facts.sockets_at_port) return {{Verdict::kOk, kMembership, counts}};
  const std::string mend_text = "; restart those that receive nothing: " + names_of(facts);
  if (!elsewhere.empty()) {
    return {{Verdict::kWrong, kMembership, counts + " and others on " + elsewhere + mend_text,
             end_all(facts)}};
  }
  if (here == 0) {
    return {{Verdict::kWrong, kMembership,
             counts +
                 ": these programs receive nothing, as with liblcm's receivers after their "
                 "interface was down" +
                 mend_text,
             end_all(facts)}};
  }
  return {{Verdict::kNote, kMembership, counts}};
}

}  // namespace puck
