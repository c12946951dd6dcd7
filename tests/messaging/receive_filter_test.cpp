#include "common/messaging/receive_filter.h"

#include <array>
#include <string>
#include <string_view>

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "common/posix/file_descriptor.h"

namespace puck {
namespace {

/// A UDP socket of its own on this host that sends to itself.
class OwnSocket {
 public:
  OwnSocket() : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address_;
    REQUIRE(bind(get(), reinterpret_cast<const sockaddr*>(&address_), size) == 0);
    REQUIRE(getsockname(get(), reinterpret_cast<sockaddr*>(&address_), &size) == 0);
  }

  int get() const { return socket_.number(); }

  /// Whether a datagram passes.
  bool lets_through(std::string_view datagram) { return received_bytes(datagram) > 0; }

  /// Length of the passed part; on the loopback it arrives at once or never.
  std::size_t received_bytes(std::string_view datagram) {
    sendto(get(), datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&address_),
           sizeof address_);
    std::array<char, 2000> received{};
    const ssize_t size = recv(get(), received.data(), received.size(), MSG_DONTWAIT);
    return size < 0 ? 0 : static_cast<std::size_t>(size);
  }

 private:
  FileDescriptor socket_;
  sockaddr_in address_{};
};

std::string message_on(const std::string& channel, const std::string& magic = "LC02") {
  return magic + std::string(4, '\1') + channel + '\0' + std::string(100, 'x');
}

}  // namespace

TEST_CASE("only messages on the requested channels pass, whole and by their full name") {
  OwnSocket socket;
  REQUIRE(filter_channels(socket.get(), {"PUCK_STATUS", "LEFT_PUCK_ARM_STATE"}, false));
  CHECK(socket.lets_through(message_on("PUCK_STATUS")));
  CHECK(socket.lets_through(message_on("LEFT_PUCK_ARM_STATE")));
  CHECK_FALSE(socket.lets_through(message_on("PUCK_EVENTS")));
  CHECK_FALSE(socket.lets_through(message_on("PUCK_STATUS_2")));
  CHECK_FALSE(socket.lets_through(message_on("PUCK_STATU")));
  CHECK_FALSE(socket.lets_through(message_on("LEFT_PUCK_ARM_STATF")));
  CHECK_FALSE(socket.lets_through(message_on("")));
  // A part of a larger message, which ours never are.
  CHECK_FALSE(socket.lets_through(message_on("PUCK_STATUS", "LC03")));
  CHECK_FALSE(socket.lets_through("LC02"));
  CHECK_FALSE(socket.lets_through(""));
}

TEST_CASE("names of every length are compared to the last letter") {
  for (std::size_t size = 1; size <= 40; ++size) {
    OwnSocket socket;
    const std::string name(size, 'A');
    REQUIRE(filter_channels(socket.get(), {name}, false));
    CHECK(socket.lets_through(message_on(name)));
    CHECK_FALSE(socket.lets_through(message_on(name + 'A')));
    CHECK_FALSE(socket.lets_through(message_on(std::string(size - 1, 'A') + 'B')));
  }
}

TEST_CASE("all channels with a common beginning pass, and all others are foreign") {
  OwnSocket ours;
  OwnSocket foreign;
  REQUIRE(filter_beginning(ours.get(), "LEFT_PUCK_", false));
  REQUIRE(filter_foreign(foreign.get(), "LEFT_PUCK_", false));
  const auto is_foreign = [&](std::string_view datagram) {
    const bool is_ours = ours.lets_through(datagram);
    CHECK(is_ours != foreign.lets_through(datagram));
    return !is_ours;
  };
  CHECK_FALSE(is_foreign(message_on("LEFT_PUCK_EVENTS")));
  CHECK_FALSE(is_foreign(message_on("LEFT_PUCK_NEW_THING")));
  CHECK(is_foreign(message_on("PUCK_EVENTS")));
  CHECK(is_foreign(message_on("RIGHT_PUCK_EVENTS")));
  CHECK(is_foreign(message_on("LEFT_PUCK")));
  CHECK(is_foreign(message_on("LEFT_PUCK_EVENTS", "LC03")));
  CHECK(is_foreign(message_on("LEFT_PUCK_EVENTS", "HTTP")));
  CHECK(is_foreign("LC02"));
  CHECK(is_foreign("LC02....LEFT"));
  CHECK(is_foreign("x"));
}

TEST_CASE("fragments pass where they are allowed") {
  OwnSocket ours;
  OwnSocket foreign;
  const std::string fragment = message_on("PUCK_STATUS", "LC03");
  REQUIRE(filter_channels(ours.get(), {"PUCK_STATUS"}, true));
  REQUIRE(filter_foreign(foreign.get(), "PUCK_", true));
  CHECK(ours.lets_through(fragment));
  CHECK_FALSE(foreign.lets_through(fragment));
  REQUIRE(filter_beginning(ours.get(), "PUCK_", true));
  CHECK(ours.lets_through(fragment));
}

TEST_CASE("of a foreign datagram only the beginning is kept") {
  OwnSocket socket;
  REQUIRE(filter_foreign(socket.get(), "PUCK_", false));
  CHECK(socket.received_bytes(std::string(255, 'x')) == 255);
  CHECK(socket.received_bytes(std::string(1000, 'x')) == 255);
}

TEST_CASE("a filter can be replaced") {
  OwnSocket socket;
  REQUIRE(filter_channels(socket.get(), {"PUCK_STATUS"}, false));
  REQUIRE(filter_channels(socket.get(), {}, false));
  CHECK_FALSE(socket.lets_through(message_on("PUCK_STATUS")));
  REQUIRE(filter_channels(socket.get(), {"PUCK_HEAD"}, false));
  CHECK(socket.lets_through(message_on("PUCK_HEAD")));
}

}  // namespace puck
