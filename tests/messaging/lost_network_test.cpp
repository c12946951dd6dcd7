// A network that goes away while a bus is on it.
#include <chrono>

#include <doctest/doctest.h>

#include "common/messaging/bus.h"
#include "tests/support/network_namespace.h"
#include "tests/support/test_url.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

bool plug_in() {
  return ip("link add cable type veth peer name far_end") && ip("link set far_end up") &&
         ip("addr add 10.9.8.7/24 dev cable") && ip("link set cable up") &&
         ip("route add 224.0.0.0/4 dev cable");
}

bool pull_out() { return ip("link delete cable"); }

/// Publishes until the message is received, for up to 10 s.
bool hears_itself(Bus& bus, int& heard) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  const int before = heard;
  while (heard == before && std::chrono::steady_clock::now() < end) {
    head_state_t head{};
    bus.publish(head);
    bus.handle(milliseconds(20));
  }
  return heard > before;
}

}  // namespace

TEST_CASE("a bus receives again after its network was away and has returned") {
  in_network_of_its_own([] {
    REQUIRE(plug_in());
    Bus bus({.url = private_lcm_url()});
    int heard = 0;
    bus.subscribe<head_state_t>([&](const head_state_t&, const Receipt&) { ++heard; });
    REQUIRE(bus.start({}, [](const std::string& reason) { MESSAGE(reason); }));
    REQUIRE(hears_itself(bus, heard));

    // More often than a socket may join groups, so each time it must be a new one.
    for (int i = 1; i <= 25; ++i) {
      REQUIRE(pull_out());
      head_state_t head{};
      CHECK_FALSE(bus.publish(head));
      while (bus.handle(milliseconds(0)) > 0) {
      }
      REQUIRE(plug_in());
      REQUIRE(hears_itself(bus, heard));
      CHECK(bus.network_counters().rejoined == i);
    }
  });
}

TEST_CASE("a bus follows its route to another interface") {
  in_network_of_its_own([] {
    REQUIRE(plug_in());
    Bus bus({.url = private_lcm_url()});
    int heard = 0;
    bus.subscribe<head_state_t>([&](const head_state_t&, const Receipt&) { ++heard; });
    REQUIRE(bus.start({}, [](const std::string& reason) { MESSAGE(reason); }));
    REQUIRE(ip("link add other type veth peer name other_end"));
    REQUIRE(ip("link set other_end up"));
    REQUIRE(ip("addr add 10.9.9.7/24 dev other"));
    REQUIRE(ip("link set other up"));
    REQUIRE(ip("route replace 224.0.0.0/4 dev other"));
    CHECK(hears_itself(bus, heard));
  });
}

}  // namespace puck
