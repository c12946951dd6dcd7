#include "tools/doctor/checks.h"

namespace puck {

Findings check_port_users(const Facts& facts) {
  constexpr const char* kPort = "port";
  const std::string port = "UDP port " + std::to_string(facts.url.port);
  if (facts.sockets_at_port == 0) {
    return {{Verdict::kOk, kPort, "no other program on this host listens at " + port}};
  }
  std::string names;
  int known_sockets = 0;
  for (const PortUser& user : facts.port_users) {
    names += (names.empty() ? "" : ", ") + to_string(user.program);
    known_sockets += user.sockets;
  }
  if (known_sockets < facts.sockets_at_port) {
    names += (names.empty() ? "" : ", ") + std::string("and programs that this user may not see");
  }
  return {{Verdict::kOk, kPort, "at " + port + " on this host: " + names}};
}

}  // namespace puck
