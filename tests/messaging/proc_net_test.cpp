#include "common/messaging/proc_net.h"

#include <algorithm>

#include <arpa/inet.h>
#include <doctest/doctest.h>

#include "common/messaging/network_interfaces.h"

namespace puck {
namespace {

// As the kernel of a little-endian machine prints it, which is what this test runs on.
constexpr std::string_view kIgmp =
    "Idx\tDevice    : Count Querier\tGroup    Users Timer\tReporter\n"
    "1\tlo        :     1      V3\n"
    "\t\t\t\t010000E0     1 0:00000000\t\t0\n"
    "4\teth0      :     2      V3\n"
    "\t\t\t\t434CFFEF     3 0:00000000\t\t0\n"
    "\t\t\t\t010000E0     1 0:00000000\t\t0\n";

constexpr std::string_view kUdp =
    "   sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout "
    "inode ref pointer drops            \n"
    "  123: 00000000:1DF3 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 "
    "4711 2 0000000000000000 5         \n"
    "  124: 0100007F:0035 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 "
    "4712 2 0000000000000000 0         \n";

constexpr std::string_view kSnmp =
    "Ip: Forwarding ReasmFails FragOKs\nIp: 1 64 3\n"
    "Udp: InDatagrams InErrors RcvbufErrors\nUdp: 5400 5139 17\n";

}  // namespace

TEST_CASE("group memberships are read with their interface and the member sockets") {
  REQUIRE(htonl(1) != 1);
  const auto memberships = parse_memberships(kIgmp);
  REQUIRE(memberships.size() == 3);
  CHECK(memberships[0].interface == "lo");
  CHECK(memberships[0].group == "224.0.0.1");
  CHECK(memberships[1].interface == "eth0");
  CHECK(memberships[1].group == "239.255.76.67");
  CHECK(memberships[1].users == 3);
}

TEST_CASE("UDP sockets are read with address, port and inode") {
  const auto sockets = parse_udp_sockets(kUdp);
  REQUIRE(sockets.size() == 2);
  CHECK(sockets[0].address == "0.0.0.0");
  CHECK(sockets[0].port == 7667);
  CHECK(sockets[0].inode == 4711);
  CHECK(sockets[1].address == "127.0.0.1");
  CHECK(sockets[1].port == 53);
}

TEST_CASE("a counter is found by its protocol and name") {
  CHECK(find_counter(kSnmp, "Ip", "ReasmFails") == 64);
  CHECK(find_counter(kSnmp, "Udp", "RcvbufErrors") == 17);
  CHECK(find_counter(kSnmp, "Udp", "ReasmFails") == std::nullopt);
  CHECK(find_counter(kSnmp, "Tcp", "InErrors") == std::nullopt);
  CHECK(find_counter("Ip: A B\nIp: 1", "Ip", "B") == std::nullopt);
  CHECK(find_counter("Ip: A", "Ip", "A") == std::nullopt);
}

TEST_CASE("empty, truncated and garbage tables give nothing") {
  for (const std::string_view text : {"", "\n", "\t\n", "x", "1\n\t\tZZ 1\n", ": : : : : : : : : :",
                                      "1: 00:FFFFFFFFFFFF a b c d e f g h i"}) {
    CAPTURE(text);
    CHECK(parse_memberships(text).empty());
    CHECK(parse_udp_sockets(text).empty());
    CHECK(find_counter(text, "Udp", "InErrors") == std::nullopt);
  }
}

TEST_CASE("the loopback is among the interfaces, and the route to 127.0.0.1 leads over it") {
  const auto interfaces = list_network_interfaces();
  const auto lo = std::find_if(interfaces.begin(), interfaces.end(),
                               [](const auto& interface) { return interface.name == "lo"; });
  REQUIRE(lo != interfaces.end());
  CHECK(lo->is_loopback);
  CHECK(lo->mtu_bytes >= 1500);
  const auto route = find_kernel_route("127.0.0.1");
  REQUIRE(std::holds_alternative<KernelRoute>(route));
  CHECK(std::get<KernelRoute>(route).interface == "lo");
  CHECK(std::get<KernelRoute>(route).source == "127.0.0.1");
  CHECK(std::holds_alternative<std::string>(find_kernel_route("nowhere")));
}

}  // namespace puck
