#include "common/messaging/multicast_route.h"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <random>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include "common/posix/file_descriptor.h"

namespace puck {
namespace {

constexpr int kTimeoutMs = 100;

std::string problem(const LcmUrl& url, const std::string& what) {
  return "no route to the multicast group " + url.group + " yet (" + what +
         "); add a default route, or run \"ip route add 224.0.0.0/4 dev DEVICE\"";
}

std::string error_text() { return std::strerror(errno); }

/// Our own datagram, identified by its content, came within the time limit.
bool comes_back(int fd, std::uint64_t token) {
  pollfd waiting{fd, POLLIN, 0};
  while (poll(&waiting, 1, kTimeoutMs) > 0) {
    std::uint64_t received = 0;
    if (recv(fd, &received, sizeof received, 0) == sizeof received && received == token) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::optional<std::string> find_route_problem(const LcmUrl& url) {
  const FileDescriptor probe(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!probe.is_open()) return problem(url, error_text());

  // The kernel chooses an unused port, so that no bus receives the probe.
  sockaddr_in address{};
  address.sin_family = AF_INET;
  socklen_t size = sizeof address;
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  if (bind(probe.number(), generic, size) != 0 ||
      getsockname(probe.number(), generic, &size) != 0) {
    return problem(url, error_text());
  }
  ip_mreq membership{};
  inet_pton(AF_INET, url.group.c_str(), &membership.imr_multiaddr);
  if (setsockopt(probe.number(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) !=
      0) {
    return problem(url, error_text());
  }
  const unsigned char this_host_only = 0;
  setsockopt(probe.number(), IPPROTO_IP, IP_MULTICAST_TTL, &this_host_only, sizeof this_host_only);

  const std::uint64_t token = std::random_device{}();
  address.sin_addr = membership.imr_multiaddr;
  if (sendto(probe.number(), &token, sizeof token, 0, generic, size) < 0) {
    return problem(url, error_text());
  }
  if (!comes_back(probe.number(), token)) {
    return problem(url, "multicast sent from this host does not loop back to it");
  }
  return std::nullopt;
}

}  // namespace puck
