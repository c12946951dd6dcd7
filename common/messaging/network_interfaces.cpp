#include "common/messaging/network_interfaces.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include "common/messaging/ipv4.h"
#include "common/posix/file_descriptor.h"

namespace puck {
namespace {

int mtu_of(const FileDescriptor& any_socket, const std::string& name) {
  ifreq request{};
  name.copy(request.ifr_name, sizeof request.ifr_name - 1);
  return ioctl(any_socket.number(), SIOCGIFMTU, &request) == 0 ? request.ifr_mtu : 0;
}

/// Request to the kernel for the route to one IPv4 address.
struct RouteRequest {
  nlmsghdr header{};
  rtmsg route{};
  rtattr destination{};
  in_addr address{};
};

RouteRequest route_request(const in_addr& address) {
  RouteRequest request;
  request.header.nlmsg_len = sizeof request;
  request.header.nlmsg_type = RTM_GETROUTE;
  request.header.nlmsg_flags = NLM_F_REQUEST;
  request.route.rtm_family = AF_INET;
  request.route.rtm_dst_len = 32;
  request.destination.rta_type = RTA_DST;
  request.destination.rta_len = RTA_LENGTH(sizeof address);
  request.address = address;
  return request;
}

std::variant<KernelRoute, std::string> read_route(nlmsghdr& header) {
  if (header.nlmsg_type == NLMSG_ERROR) {
    const auto& error = *static_cast<const nlmsgerr*>(NLMSG_DATA(&header));
    return std::string(std::strerror(-error.error));
  }
  KernelRoute route;
  auto left = static_cast<int>(RTM_PAYLOAD(&header));
  for (rtattr* attribute = RTM_RTA(NLMSG_DATA(&header)); RTA_OK(attribute, left);
       attribute = RTA_NEXT(attribute, left)) {
    if (attribute->rta_type == RTA_OIF) {
      unsigned index = 0;
      std::memcpy(&index, RTA_DATA(attribute), sizeof index);
      std::array<char, IF_NAMESIZE> name{};
      if (if_indextoname(index, name.data()) != nullptr) route.interface = name.data();
    } else if (attribute->rta_type == RTA_PREFSRC) {
      in_addr source{};
      std::memcpy(&source, RTA_DATA(attribute), sizeof source);
      if (source.s_addr != INADDR_ANY) route.source = dotted(source);
    }
  }
  if (route.interface.empty()) return "the kernel names no interface";
  return route;
}

}  // namespace

std::vector<NetworkInterface> list_network_interfaces() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, &freeifaddrs);
  const FileDescriptor any_socket(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  std::vector<NetworkInterface> interfaces;
  // One entry for each interface and address, and one for an interface without an address.
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    auto known = std::find_if(interfaces.begin(), interfaces.end(),
                              [&](const auto& other) { return other.name == entry->ifa_name; });
    if (known == interfaces.end()) {
      const unsigned flags = entry->ifa_flags;
      interfaces.push_back({.name = entry->ifa_name,
                            .is_up = (flags & IFF_UP) != 0,
                            .has_link = (flags & IFF_RUNNING) != 0,
                            .is_loopback = (flags & IFF_LOOPBACK) != 0,
                            .can_multicast = (flags & IFF_MULTICAST) != 0,
                            .mtu_bytes = mtu_of(any_socket, entry->ifa_name)});
      known = std::prev(interfaces.end());
    }
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    known->addresses.push_back(
        dotted(reinterpret_cast<const sockaddr_in*>(entry->ifa_addr)->sin_addr));
  }
  return interfaces;
}

std::variant<KernelRoute, std::string> find_kernel_route(const std::string& address) {
  in_addr destination{};
  if (inet_pton(AF_INET, address.c_str(), &destination) != 1) return address + " is no address";
  const FileDescriptor netlink(socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  const RouteRequest request = route_request(destination);
  alignas(nlmsghdr) std::array<char, 4096> answer{};
  if (send(netlink.number(), &request, sizeof request, 0) < 0) return std::strerror(errno);
  const ssize_t size = recv(netlink.number(), answer.data(), answer.size(), 0);
  if (size < 0) return std::strerror(errno);
  auto* header = reinterpret_cast<nlmsghdr*>(answer.data());
  if (!NLMSG_OK(header, static_cast<std::size_t>(size))) return "the kernel's answer is cut off";
  return read_route(*header);
}

}  // namespace puck
