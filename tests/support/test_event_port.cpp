#include "tests/support/test_event_port.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <list>
#include <mutex>
#include <stdexcept>
#include <stop_token>
#include <utility>
#include <vector>

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/support/test_board_bytes.h"

namespace puck {
namespace {

using namespace std::string_literals;

struct Peer {
  int socket = -1;
  bool asks_names = false;
  std::string in;
  std::string out;
  bool is_greeted = false;
  bool is_reader = false;
  bool is_over = false;
};

int listen_at(int port) {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int on = 1;
  setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
      listen(listener, 16) != 0) {
    close(listener);
    throw std::runtime_error("cannot listen on port " + std::to_string(port));
  }
  return listener;
}

int number_of(int listener) {
  sockaddr_in address{};
  socklen_t length = sizeof address;
  getsockname(listener, reinterpret_cast<sockaddr*>(&address), &length);
  return ntohs(address.sin_port);
}

}  // namespace

class TestEventPort::Ports {
 public:
  Ports(std::string name, int name_server)
      : name_(std::move(name)), names_(listen_at(name_server)) {
    revive();
  }
  ~Ports() {
    close(names_);
    if (events_ >= 0) close(events_);
    for (const Peer& peer : peers_) close(peer.socket);
  }
  Ports(const Ports&) = delete;
  Ports& operator=(const Ports&) = delete;

  int name_server() const { return number_of(names_); }
  std::mutex& mutex() { return mutex_; }

  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      wait();
      const std::lock_guard lock(mutex_);
      accept_all(names_, true);
      if (events_ >= 0) accept_all(events_, false);
      for (Peer& peer : peers_) attend(peer);
      peers_.remove_if([](const Peer& peer) {
        if (peer.is_over) close(peer.socket);
        return peer.is_over;
      });
    }
  }

  bool send(std::string_view bytes) {
    bool has_reader = false;
    for (Peer& peer : peers_) {
      if (!peer.is_reader) continue;
      peer.out += bytes;
      has_reader = true;
    }
    return has_reader;
  }
  std::size_t readers() const {
    std::size_t count = 0;
    for (const Peer& peer : peers_) count += peer.is_reader ? 1 : 0;
    return count;
  }
  std::size_t unsent() const {
    std::size_t bytes = 0;
    for (const Peer& peer : peers_) bytes += peer.out.size();
    return bytes;
  }
  void die() {
    close(std::exchange(events_, -1));
    for (Peer& peer : peers_) peer.is_over = !peer.asks_names;
  }
  void revive() { events_ = listen_at(0); }

 private:
  void wait() {
    std::vector<pollfd> sockets;
    {
      const std::lock_guard lock(mutex_);
      sockets.push_back({names_, POLLIN, 0});
      if (events_ >= 0) sockets.push_back({events_, POLLIN, 0});
      for (const Peer& peer : peers_) {
        const short events = peer.out.empty() ? POLLIN : POLLIN | POLLOUT;
        sockets.push_back({peer.socket, events, 0});
      }
    }
    poll(sockets.data(), sockets.size(), 2);
  }

  void accept_all(int listener, bool asks_names) {
    while (true) {
      const int socket = accept4(listener, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
      if (socket < 0) return;
      peers_.push_back({.socket = socket, .asks_names = asks_names});
    }
  }

  void attend(Peer& peer) {
    std::array<char, 4096> piece{};
    const ssize_t count = recv(peer.socket, piece.data(), piece.size(), 0);
    if (count == 0 || (count < 0 && errno != EAGAIN)) peer.is_over = true;
    if (count > 0) peer.in.append(piece.data(), static_cast<std::size_t>(count));
    if (peer.asks_names) {
      answer_names(peer);
    } else {
      answer_reader(peer);
    }
    const ssize_t sent = ::send(peer.socket, peer.out.data(), peer.out.size(), MSG_NOSIGNAL);
    if (sent > 0) peer.out.erase(0, static_cast<std::size_t>(sent));
  }

  void answer_names(Peer& peer) {
    for (std::size_t end = 0; (end = peer.in.find('\n')) != std::string::npos;) {
      const std::string line = peer.in.substr(0, end);
      peer.in.erase(0, end + 1);
      if (line.starts_with("CONNECT ")) peer.out += "Welcome " + line.substr(8) + "\r\n";
      if (!line.starts_with("query ")) continue;
      if (line == "query " + name_ && events_ >= 0) {
        peer.out += "registration name " + name_ + " ip 127.0.0.1 port " +
                    std::to_string(number_of(events_)) + " type tcp\r\n";
      }
      peer.out += "*** end of message\r\n";
    }
  }

  void answer_reader(Peer& peer) {
    if (!peer.is_greeted && take_hello(peer.in)) {
      peer.is_greeted = true;
      peer.out += "YA\x1A\x27\0\0RP"s;
    }
    if (!peer.is_greeted) return;
    const auto blocks = take_message(peer.in);
    if (blocks && (*blocks)[0][5] == 'r') peer.is_reader = true;
  }

  std::mutex mutex_;  // Guards what follows.
  std::string name_;
  int names_ = -1;
  int events_ = -1;
  std::list<Peer> peers_;
};

TestEventPort::TestEventPort(std::string name, int name_server)
    : ports_(std::make_unique<Ports>(std::move(name), name_server)),
      thread_([this](const std::stop_token& stop) { ports_->run(stop); }) {}

TestEventPort::~TestEventPort() = default;

int TestEventPort::name_server() const {
  const std::lock_guard lock(ports_->mutex());
  return ports_->name_server();
}

bool TestEventPort::send(std::string_view bytes) {
  const std::lock_guard lock(ports_->mutex());
  return ports_->send(bytes);
}

std::size_t TestEventPort::readers() const {
  const std::lock_guard lock(ports_->mutex());
  return ports_->readers();
}

std::size_t TestEventPort::unsent() const {
  const std::lock_guard lock(ports_->mutex());
  return ports_->unsent();
}

void TestEventPort::die() {
  while (unsent() > 0) std::this_thread::yield();
  const std::lock_guard lock(ports_->mutex());
  ports_->die();
}

void TestEventPort::revive() {
  const std::lock_guard lock(ports_->mutex());
  ports_->revive();
}

}  // namespace puck
