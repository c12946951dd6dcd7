#include "tools/doctor/checks.h"

namespace puck {

Findings examine(const Facts& facts) {
  Findings all;
  for (const auto check :
       {check_route, check_interface, check_ttl, check_mtu, check_buffer, check_membership,
        check_firewall, check_reverse_path, check_self_test, check_counters, check_port_users,
        check_senders, check_key, check_services, check_versions, check_clocks}) {
    const Findings findings = check(facts);
    all.insert(all.end(), findings.begin(), findings.end());
  }
  return all;
}

}  // namespace puck
