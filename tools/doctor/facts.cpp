#include "tools/doctor/facts.h"

#include <algorithm>

namespace puck {

std::string to_string(const Program& program) {
  return program.name + " (pid " + std::to_string(program.pid) + ")";
}

const NetworkInterface* Facts::group_interface() const {
  const auto* to_group = std::get_if<KernelRoute>(&route);
  if (to_group == nullptr) return nullptr;
  const auto found = std::find_if(
      interfaces.begin(), interfaces.end(),
      [&](const NetworkInterface& interface) { return interface.name == to_group->interface; });
  return found == interfaces.end() ? nullptr : &*found;
}

bool Facts::is_own_address(const std::string& address) const {
  // Source address of datagrams from an interface without an address.
  if (address == "0.0.0.0") return true;
  return std::any_of(interfaces.begin(), interfaces.end(), [&](const auto& interface) {
    return std::find(interface.addresses.begin(), interface.addresses.end(), address) !=
           interface.addresses.end();
  });
}

}  // namespace puck
