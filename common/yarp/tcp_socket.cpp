#include "common/yarp/tcp_socket.h"

#include <cerrno>
#include <cstring>
#include <string>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include "common/posix/dead_peer.h"
#include "common/yarp/yarp_error.h"

namespace puck {
namespace {

bool is_would_block(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

void check_connected(int socket) {
  int error = 0;
  socklen_t length = sizeof error;
  getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &length);
  if (error != 0) throw YarpError(std::strerror(error));
}

void connect_by(int socket, const PortAddress& to, const Waiter& waiter, Deadline deadline) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(to.port);
  if (inet_pton(AF_INET, to.ip.c_str(), &address.sin_addr) != 1) throw YarpError("no address");
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  if (connect(socket, generic, sizeof address) != 0 && errno != EINPROGRESS) {
    throw YarpError(std::strerror(errno));
  }
  if (!waiter.wait_for(socket, POLLOUT, deadline)) throw YarpError("no answer in time");
  check_connected(socket);
  notice_dead_peer(socket);
  // Set-points are small: no delay (Nagle), and a small buffer, so that a newer one can replace one
  // not sent yet.
  const int on = 1;
  const int few_bytes = 4096;
  setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &few_bytes, sizeof few_bytes);
}

}  // namespace

TcpSocket::TcpSocket(const PortAddress& address, const Waiter& waiter, Deadline deadline)
    : socket_(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  const std::string to = "cannot connect to " + address.to_string() + ": ";
  if (!socket_.is_open()) throw YarpError(to + std::strerror(errno));
  try {
    connect_by(descriptor(), address, waiter, deadline);
  } catch (const YarpError& error) {
    throw YarpError(to + error.what());
  }
}

std::size_t TcpSocket::send_now(std::span<const std::uint8_t> bytes) {
  const ssize_t sent = ::send(descriptor(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (sent >= 0) return static_cast<std::size_t>(sent);
  if (is_would_block(errno)) return 0;
  throw YarpError(std::string("the connection broke: ") + std::strerror(errno));
}

std::size_t TcpSocket::receive_now(std::span<std::uint8_t> bytes) {
  const ssize_t received = recv(descriptor(), bytes.data(), bytes.size(), 0);
  if (received > 0) return static_cast<std::size_t>(received);
  if (received == 0) throw YarpError("it closed the connection");
  if (is_would_block(errno)) return 0;
  throw YarpError(std::string("the connection broke: ") + std::strerror(errno));
}

void TcpSocket::send(std::span<const std::uint8_t> bytes, const Waiter& waiter, Deadline deadline) {
  while (!bytes.empty()) {
    if (!waiter.wait_for(descriptor(), POLLOUT, deadline)) throw YarpError("it accepts no bytes");
    bytes = bytes.subspan(send_now(bytes));
  }
}

std::size_t TcpSocket::receive(std::span<std::uint8_t> bytes, const Waiter& waiter,
                               Deadline deadline) {
  while (true) {
    if (!waiter.wait_for(descriptor(), POLLIN, deadline)) throw YarpError("no answer in time");
    const std::size_t received = receive_now(bytes);
    if (received > 0) return received;
  }
}

}  // namespace puck
