#pragma once

#include <string>

#include <unistd.h>

namespace puck {

/// A bus for this process alone: on this host, on a port that no other test uses at the time and
/// the kernel does not assign (below 32768). Up to 8 of them.
inline std::string private_lcm_url(int which = 0) {
  const int port = 20000 + static_cast<int>((getpid() * 8L + which) % 12000);
  return "udpm://239.255.76.67:" + std::to_string(port) + "?ttl=0&recv_buf_size=4194304";
}

}  // namespace puck
