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

/// Whether any interface of this host is in the group, as the kernel lists them.
bool is_joined_anywhere(const LcmUrl& url) {
  std::ifstream igmp("/proc/self/net/igmp");
  if (!igmp) return true;  // It cannot be told.
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

  // What comes before the caller has said what it wants is not taken for anything.
  filter_channels(descriptor(), {}, false);
  // Others on this host hear the same group.
  set_option(descriptor(), SOL_SOCKET, SO_REUSEADDR, 1);
  set_option(descriptor(), SOL_SOCKET, SO_TIMESTAMPNS, 1);
  if (buffer_bytes) {
    set_option(descriptor(), SOL_SOCKET, SO_RCVBUF, *buffer_bytes);
    // Beyond net.core.rmem_max, where this process may.
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
  // The kernel takes a membership twice only when the way to the group leads through another
  // interface than before; an interface keeps its number as long as it lives.
  if (join(descriptor(), url_) == 0) return true;
  return errno == EADDRINUSE && !is_joined_anywhere(url_);
}

}  // namespace puck
