#include "tools/doctor/udp_listener.h"

#include <cerrno>
#include <cstring>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <time.h>

#include "common/messages/host_time.h"
#include "common/messaging/ipv4.h"

namespace puck {
namespace {

void ask_for_buffer(int socket, const LcmUrl& url) {
  if (!url.recv_buf_size) return;
  setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &*url.recv_buf_size, sizeof *url.recv_buf_size);
}

void set_flag(int socket, int level, int option) {
  const int on = 1;
  setsockopt(socket, level, option, &on, sizeof on);
}

std::string error_text() { return std::strerror(errno); }

/// Why the socket cannot be opened; empty: it is open.
std::string open_problem(int socket, const LcmUrl& url) {
  set_flag(socket, SOL_SOCKET, SO_REUSEADDR);
  set_flag(socket, SOL_SOCKET, SO_TIMESTAMPNS);
  set_flag(socket, IPPROTO_IP, IP_RECVTTL);
  ask_for_buffer(socket, url);
  const sockaddr_in address = group_address(url);
  if (bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return "port " + std::to_string(url.port) + " cannot be shared (" + error_text() + ")";
  }
  const ip_mreq membership{address.sin_addr, {}};
  if (setsockopt(socket, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) != 0) {
    return "the group " + url.group + " cannot be joined (" + error_text() + ")";
  }
  return {};
}

void read_ancillary(msghdr& header, ReceivedDatagram& datagram) {
  for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
    if (part->cmsg_level == IPPROTO_IP && part->cmsg_type == IP_TTL) {
      int ttl = 0;
      std::memcpy(&ttl, CMSG_DATA(part), sizeof ttl);
      datagram.ttl = ttl;
    } else if (part->cmsg_level == SOL_SOCKET && part->cmsg_type == SCM_TIMESTAMPNS) {
      timespec time{};
      std::memcpy(&time, CMSG_DATA(part), sizeof time);
      datagram.utime = std::int64_t{time.tv_sec} * 1'000'000 + time.tv_nsec / 1000;
    }
  }
}

}  // namespace

UdpListener::UdpListener(const LcmUrl& url)
    : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  if (!socket_.is_open()) throw ListenError("no socket (" + error_text() + ")");
  const std::string problem = open_problem(socket_.number(), url);
  if (!problem.empty()) throw ListenError(problem);
}

std::optional<ReceivedDatagram> UdpListener::receive(std::chrono::milliseconds timeout) {
  pollfd waiting{socket_.number(), POLLIN, 0};
  if (poll(&waiting, 1, static_cast<int>(timeout.count())) <= 0) return std::nullopt;
  sockaddr_in from{};
  iovec data{buffer_.data(), buffer_.size()};
  alignas(cmsghdr) std::array<char, 256> control{};
  msghdr header{};
  header.msg_name = &from;
  header.msg_namelen = sizeof from;
  header.msg_iov = &data;
  header.msg_iovlen = 1;
  header.msg_control = control.data();
  header.msg_controllen = control.size();
  const ssize_t size = recvmsg(socket_.number(), &header, MSG_DONTWAIT);
  if (size < 0) return std::nullopt;

  ReceivedDatagram datagram;
  datagram.source = {dotted(from.sin_addr), ntohs(from.sin_port)};
  datagram.utime = host_utime();  // If the kernel gives no time.
  datagram.bytes = {buffer_.data(), static_cast<std::size_t>(size)};
  read_ancillary(header, datagram);
  return datagram;
}

std::optional<std::int64_t> granted_buffer_bytes(const LcmUrl& url) {
  const FileDescriptor probe(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!probe.is_open()) return std::nullopt;
  ask_for_buffer(probe.number(), url);
  int bytes = 0;
  socklen_t size = sizeof bytes;
  if (getsockopt(probe.number(), SOL_SOCKET, SO_RCVBUF, &bytes, &size) != 0) return std::nullopt;
  // The kernel doubles the requested size for its bookkeeping.
  return url.recv_buf_size ? bytes / 2 : bytes;
}

}  // namespace puck
