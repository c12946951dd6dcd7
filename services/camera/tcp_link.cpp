#include "services/camera/tcp_link.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include "common/posix/dead_peer.h"

namespace puck {
namespace {

using LinkClock = std::chrono::steady_clock;

constexpr std::chrono::seconds kRetryAfter{1};
constexpr int kWaitingClients = 4;

struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t length = 0;

  const sockaddr* generic() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

std::vector<SocketAddress> addresses_of(const std::string& host, int port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (error != 0) {
    throw std::runtime_error("camera.tcp_host \"" + host +
                             "\" cannot be found: " + gai_strerror(error));
  }
  std::vector<SocketAddress> addresses;
  for (const addrinfo* each = found; each != nullptr; each = each->ai_next) {
    SocketAddress& address = addresses.emplace_back();
    std::memcpy(&address.storage, each->ai_addr, each->ai_addrlen);
    address.length = each->ai_addrlen;
  }
  freeaddrinfo(found);
  return addresses;
}

FileDescriptor open_socket(const SocketAddress& address) {
  constexpr int kKind = SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC;
  return FileDescriptor(socket(address.storage.ss_family, kKind, 0));
}

class ClientLink final : public TcpLink {
 public:
  ClientLink(const std::string& host, int port)
      : name_(host + ":" + std::to_string(port)),
        addresses_(addresses_of(host, port)),
        waiting_for_("a connection to " + name_) {}

  FileDescriptor connect() override {
    if (!socket_.is_open()) {
      if (LinkClock::now() < next_attempt_) return {};
      begin();
    }
    if (!socket_.is_open()) return {};
    pollfd waiting{socket_.number(), POLLOUT, 0};
    if (poll(&waiting, 1, 0) <= 0) {
      if (LinkClock::now() >= next_attempt_) note_end("it does not answer");
      return {};
    }
    int error = 0;
    socklen_t length = sizeof error;
    getsockopt(socket_.number(), SOL_SOCKET, SO_ERROR, &error, &length);
    if (error != 0) {
      note_end(std::strerror(error));
      return {};
    }
    return std::move(socket_);
  }

  const std::string& waiting_for() const override { return waiting_for_; }

  void note_end(const std::string& reason) override {
    socket_ = {};
    waiting_for_ = "a connection to " + name_ + ": " + reason;
    next_attempt_ = LinkClock::now() + kRetryAfter;
  }

  const std::string& name() const override { return name_; }

 private:
  void begin() {
    next_attempt_ = LinkClock::now() + kRetryAfter;
    const SocketAddress& address = addresses_[next_address_];
    next_address_ = (next_address_ + 1) % addresses_.size();
    socket_ = open_socket(address);
    if (!socket_.is_open() ||
        (::connect(socket_.number(), address.generic(), address.length) != 0 &&
         errno != EINPROGRESS)) {
      note_end(std::strerror(errno));
      return;
    }
    notice_dead_peer(socket_.number());
  }

  std::string name_;
  std::vector<SocketAddress> addresses_;  // All addresses of the host, tried in turn.
  std::size_t next_address_ = 0;
  FileDescriptor socket_;  // Until it is connected.
  LinkClock::time_point next_attempt_;
  std::string waiting_for_;
};

class ServerLink final : public TcpLink {
 public:
  ServerLink(const std::string& host, int port) {
    const std::string at = host + ":" + std::to_string(port);
    const SocketAddress address = addresses_of(host, port).front();
    socket_ = open_socket(address);
    const int on = 1;
    setsockopt(socket_.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (!socket_.is_open() || bind(socket_.number(), address.generic(), address.length) != 0 ||
        listen(socket_.number(), kWaitingClients) != 0) {
      throw std::runtime_error("camera.tcp_host: cannot listen at " + at + ": " +
                               std::strerror(errno) +
                               "; expected a free port of an address of this machine");
    }
    name_ = "a client of " + host + ":" + std::to_string(port != 0 ? port : bound_port());
    waiting_for_ = name_;
  }

  FileDescriptor connect() override {
    FileDescriptor client(
        accept4(socket_.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (client.is_open()) notice_dead_peer(client.number());
    return client;
  }

  const std::string& waiting_for() const override { return waiting_for_; }
  void note_end(const std::string& reason) override {
    waiting_for_ = name_ + "; the previous one: " + reason;
  }
  const std::string& name() const override { return name_; }

 private:
  int bound_port() const {
    sockaddr_storage bound{};
    socklen_t length = sizeof bound;
    getsockname(socket_.number(), reinterpret_cast<sockaddr*>(&bound), &length);
    // Both families have the port at the same place.
    return ntohs(reinterpret_cast<const sockaddr_in*>(&bound)->sin_port);
  }

  FileDescriptor socket_;
  std::string name_;
  std::string waiting_for_;
};

}  // namespace

std::unique_ptr<TcpLink> connect_to_server(const std::string& host, int port) {
  return std::make_unique<ClientLink>(host, port);
}

std::unique_ptr<TcpLink> listen_for_clients(const std::string& host, int port) {
  return std::make_unique<ServerLink>(host, port);
}

}  // namespace puck
