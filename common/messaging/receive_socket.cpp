#include "common/messaging/receive_socket.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <netinet/in.h>
#include <sys/socket.h>

#include "common/messaging/ipv4.h"
#include "common/messaging/proc_net.h"
#include "common/messaging/receive_filter.h"

namespace puck {
namespace {

int join(int socket, const LcmUrl& url) {
  ip_mreq membership{};
  membership.imr_multiaddr = group_address(url).sin_addr;
  return setsockopt(socket, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership);
}

/// Whether any interface of this host has joined the group, by the kernel's list.
bool is_joined_anywhere(const LcmUrl& url) {
  std::ifstream igmp("/proc/self/net/igmp");
  if (!igmp) return true;  // Not known.
  const std::string text{std::istreambuf_iterator<char>(igmp), {}};
  const auto memberships = parse_memberships(text);
  return std::any_of(memberships.begin(), memberships.end(),
                     [&](const GroupMembership& known) { return known.group == url.group; });
}

void set_option(int socket, int level, int option, int value) {
  setsockopt(socket, level, option, &value, sizeof value);
}

std::string last_error() { return std::strerror(errno); }

}  // namespace

std::optional<std::string> ReceiveSocket::open(const LcmUrl& url, std::optional<int> buffer_bytes) {
  url_ = url;
  socket_ = FileDescriptor(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!is_open()) return "no socket: " + last_error();
  const auto fail = [this](const std::string& what) {
    const std::string why = what + ": " + last_error();
    socket_ = {};
    return why;
  };

  // Nothing passes until the caller has set its filter.
  filter_channels(descriptor(), {}, false);
  // Other processes of this host receive the same group.
  set_option(descriptor(), SOL_SOCKET, SO_REUSEADDR, 1);
  set_option(descriptor(), SOL_SOCKET, SO_TIMESTAMPNS, 1);
  if (buffer_bytes) {
    set_option(descriptor(), SOL_SOCKET, SO_RCVBUF, *buffer_bytes);
    // Exceeds net.core.rmem_max if this process has the privilege.
    set_option(descriptor(), SOL_SOCKET, SO_RCVBUFFORCE, *buffer_bytes);
  }
  const sockaddr_in address = group_address(url);
  if (bind(descriptor(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return fail(url.group + ":" + std::to_string(url.port) + " cannot be listened to");
  }
  if (join(descriptor(), url) != 0) return fail("the group " + url.group + " cannot be joined");
  return std::nullopt;
}

bool ReceiveSocket::has_lost_its_group() {
  // The kernel accepts a second membership only if the route to the group leads through another
  // interface; an interface keeps its index for life.
  if (join(descriptor(), url_) == 0) return true;
  return errno == EADDRINUSE && !is_joined_anywhere(url_);
}

}  // namespace puck
