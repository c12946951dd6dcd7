#include "common/messaging/receive_filter.h"

#include <array>
#include <string>
#include <string_view>

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace puck {
namespace {

/// A UDP socket of its own on this host that sends to itself.
class OwnSocket {
 public:
  OwnSocket() : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address_;
    REQUIRE(bind(socket_, reinterpret_cast<const sockaddr*>(&address_), size) == 0);
    REQUIRE(getsockname(socket_, reinterpret_cast<sockaddr*>(&address_), &size) == 0);
  }
  ~OwnSocket() { close(socket_); }
  OwnSocket(const OwnSocket&) = delete;
  OwnSocket& operator=(const OwnSocket&) = delete;

  int get() const { return socket_; }
  std::uint16_t port() const { return ntohs(address_.sin_port); }

  /// Whether a datagram comes through; on the loopback it is there at once or never.
  bool lets_through(std::string_view datagram) {
    sendto(socket_, datagram.data(), datagram.size(), 0,
           reinterpret_cast<const sockaddr*>(&address_), sizeof address_);
    std::array<char, 2000> received{};
    const ssize_t size = recv(socket_, received.data(), received.size(), MSG_DONTWAIT);
    return size == static_cast<ssize_t>(datagram.size());
  }

 private:
  int socket_;
  sockaddr_in address_{};
};

std::string message_on(const std::string& channel, const std::string& magic = "LC02") {
  return magic + std::string(4, '\1') + channel + '\0' + std::string(100, 'x');
}

}  // namespace

TEST_CASE("only messages on the channels asked for come through, whole and by their full name") {
  OwnSocket socket;
  REQUIRE(filter_channels(socket.get(), {"PUCK_STATUS", "LEFT_PUCK_ARM_STATE"}));
  CHECK(socket.lets_through(message_on("PUCK_STATUS")));
  CHECK(socket.lets_through(message_on("LEFT_PUCK_ARM_STATE")));
  CHECK_FALSE(socket.lets_through(message_on("PUCK_EVENTS")));
  CHECK_FALSE(socket.lets_through(message_on("PUCK_STATUS_2")));
  CHECK_FALSE(socket.lets_through(message_on("PUCK_STATU")));
  CHECK_FALSE(socket.lets_through(message_on("LEFT_PUCK_ARM_STATF")));
  CHECK_FALSE(socket.lets_through(message_on("")));
  // A part of a larger message: none of ours is.
  CHECK_FALSE(socket.lets_through(message_on("PUCK_STATUS", "LC03")));
  CHECK_FALSE(socket.lets_through("LC02"));
  CHECK_FALSE(socket.lets_through(""));
}

TEST_CASE("names of every length are told apart to the last letter") {
  for (std::size_t size = 1; size <= 40; ++size) {
    OwnSocket socket;
    const std::string name(size, 'A');
    REQUIRE(filter_channels(socket.get(), {name}));
    CHECK(socket.lets_through(message_on(name)));
    CHECK_FALSE(socket.lets_through(message_on(name + 'A')));
    CHECK_FALSE(socket.lets_through(message_on(std::string(size - 1, 'A') + 'B')));
  }
}

TEST_CASE("a filter can be replaced and removed") {
  OwnSocket socket;
  REQUIRE(filter_channels(socket.get(), {"PUCK_STATUS"}));
  REQUIRE(filter_channels(socket.get(), {}));
  CHECK_FALSE(socket.lets_through(message_on("PUCK_STATUS")));
  remove_filter(socket.get());
  CHECK(socket.lets_through(message_on("PUCK_STATUS")));
  CHECK(socket.lets_through("anything"));
}

TEST_CASE("a socket is found by its port") {
  const OwnSocket socket;
  const OwnSocket other;
  CHECK(udp_sockets_at(socket.port()) == std::vector<int>{socket.get()});
}

}  // namespace puck
