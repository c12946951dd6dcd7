#include "common/messaging/bus.h"

#include <stdexcept>
#include <thread>

#include <doctest/doctest.h>
#include <lcm/lcm.h>
#include <sys/socket.h>

#include "common/messaging/event_packing.h"
#include "common/posix/file_descriptor.h"
#include "tests/support/random_message.h"
#include "tests/support/test_url.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

void start(Bus& bus) {
  REQUIRE(bus.start({}, [](const std::string& reason) { MESSAGE(reason); }));
}

/// Handles until `done` or 5 s have passed.
template <typename Done>
void handle_until(Bus& bus, const Done& done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (!done() && std::chrono::steady_clock::now() < end) bus.handle(milliseconds(10));
}

/// Whether the kernel gives this user the receive buffer that the tests' URLs ask for.
bool is_given_large_buffer() {
  constexpr int kBytes = 4 << 20;
  const FileDescriptor own(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  setsockopt(own.number(), SOL_SOCKET, SO_RCVBUF, &kBytes, sizeof kBytes);
  setsockopt(own.number(), SOL_SOCKET, SO_RCVBUFFORCE, &kBytes, sizeof kBytes);
  int given = 0;
  socklen_t size = sizeof given;
  getsockopt(own.number(), SOL_SOCKET, SO_RCVBUF, &given, &size);
  return given >= kBytes;
}

/// Publishes arbitrary bytes.
class Stranger {
 public:
  explicit Stranger(const std::string& url) : lcm_(lcm_create(url.c_str())) {}
  ~Stranger() { lcm_destroy(lcm_); }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

  void publish(const std::string& channel, const std::vector<std::uint8_t>& bytes) {
    lcm_publish(lcm_, channel.c_str(), bytes.data(), static_cast<unsigned>(bytes.size()));
  }

 private:
  lcm_t* lcm_;
};

}  // namespace

TEST_CASE("a message is published with time, session and number, and received with a receipt") {
  Bus bus({.url = "memq://"});
  std::vector<head_state_t> received;
  std::vector<Receipt> receipts;
  bus.subscribe<head_state_t>([&](const head_state_t& head, const Receipt& receipt) {
    received.push_back(head);
    receipts.push_back(receipt);
  });
  start(bus);
  head_state_t head{};
  head.yaw_deg = 12.5;
  CHECK(bus.publish(head));
  CHECK(bus.publish(head));
  handle_until(bus, [&] { return received.size() == 2; });

  REQUIRE(received.size() == 2);
  CHECK(received[0].yaw_deg == 12.5);
  CHECK(received[0].session == bus.session());
  CHECK(received[0].session != 0);
  CHECK(received[0].seq == 0);
  CHECK(received[1].seq == 1);
  CHECK(received[0].utime > 1'600'000'000'000'000);
  CHECK(receipts[0].arrival == Arrival::kNewSession);
  CHECK(receipts[1].arrival == Arrival::kNewest);
  CHECK(receipts[0].bytes == static_cast<std::size_t>(head.getEncodedSize()));
  CHECK(receipts[1].monotonic_us >= receipts[0].monotonic_us);
  CHECK(bus.counters<head_state_t>().arrivals.received == 2);
  CHECK(bus.counters<head_state_t>().published == 2);
}

TEST_CASE("a new session of a bus counts from 0 on every channel, and is no loss for receivers") {
  Bus bus({.url = "memq://"});
  std::vector<head_state_t> heads;
  std::vector<Arrival> arrivals;
  bus.subscribe<head_state_t>([&](const head_state_t& head, const Receipt& receipt) {
    heads.push_back(head);
    arrivals.push_back(receipt.arrival);
  });
  start(bus);
  head_state_t head{};
  CHECK(bus.publish(head));
  CHECK(bus.publish(head));
  const std::int64_t before = bus.session();
  bus.begin_session();
  CHECK(bus.session() != before);
  CHECK(bus.publish(head));
  handle_until(bus, [&] { return heads.size() == 3; });
  REQUIRE(heads.size() == 3);
  CHECK(heads[1].session == before);
  CHECK(heads[2].session == bus.session());
  CHECK(heads[2].seq == 0);
  CHECK(arrivals[2] == Arrival::kNewSession);
  CHECK(bus.counters<head_state_t>().arrivals.lost == 0);
}

TEST_CASE("sequence numbers count the messages of one channel") {
  Bus bus({.url = "memq://"});
  start(bus);
  head_state_t head{};
  game_state_t game{};
  bus.publish(head);
  bus.publish(game);
  bus.publish(head);
  CHECK(head.seq == 1);
  CHECK(game.seq == 0);
}

TEST_CASE("several handlers of one type are all called, in order") {
  Bus bus({.url = "memq://"});
  std::string calls;
  bus.subscribe<head_state_t>([&](const head_state_t&, const Receipt&) { calls += 'a'; });
  bus.subscribe<head_state_t>([&](const head_state_t&, const Receipt&) { calls += 'b'; });
  start(bus);
  head_state_t head{};
  bus.publish(head);
  handle_until(bus, [&] { return calls.size() == 2; });
  CHECK(calls == "ab");
  CHECK(bus.counters<head_state_t>().arrivals.received == 1);
}

TEST_CASE("a handler's exception is counted, and the next message is still delivered") {
  Bus bus({.url = "memq://"});
  int calls = 0;
  bus.subscribe<head_state_t>([&](const head_state_t&, const Receipt&) {
    if (++calls == 1) throw std::runtime_error("no head");
    if (calls == 2) throw 2;
  });
  start(bus);
  head_state_t head{};
  for (int i = 0; i < 3; ++i) bus.publish(head);
  handle_until(bus, [&] { return calls == 3; });
  CHECK(calls == 3);
  CHECK(bus.counters<head_state_t>().handler_failures == 2);
  CHECK(bus.counters<head_state_t>().last_handler_failure == "unknown exception");
}

TEST_CASE("an invalid message is not sent, and counted") {
  Bus bus({.url = "memq://"});
  start(bus);
  arm_command_t command{};
  command.mode = 9;
  CHECK_FALSE(bus.publish(command));
  CHECK(bus.counters<arm_command_t>().publish_failures == 1);
  CHECK(bus.counters<arm_command_t>().last_publish_failure ==
        "arm_command_t.mode must be 0 to 3, got 9");
}

TEST_CASE("publishing before the start fails and is counted") {
  Bus bus({.url = "memq://"});
  head_state_t head{};
  CHECK_FALSE(bus.publish(head));
  CHECK(bus.counters<head_state_t>().publish_failures == 1);
  CHECK(bus.handle(milliseconds(0)) == 0);
}

TEST_CASE("a malformed URL or prefix ends the start") {
  CHECK_THROWS_AS(Bus({.url = "udpm://1.2.3.4:7667"}), BusError);
  CHECK_THROWS_AS(Bus({.url = "memq://", .prefix = "left"}), BusError);
}

TEST_CASE("a start waits for a route only until it is asked to stop") {
  Bus bus({.url = private_lcm_url()});
  std::stop_source source;
  source.request_stop();
  CHECK_FALSE(bus.start(source.get_token(), [](const std::string&) {}));
}

TEST_CASE("two buses exchange messages over UDP, and ignore other prefixes") {
  const std::string url = private_lcm_url();
  Bus sender({.url = url, .prefix = "LEFT"});
  Bus receiver({.url = url, .prefix = "LEFT"});
  Bus other({.url = url});
  int received = 0;
  int others = 0;
  receiver.subscribe<head_state_t>([&](const head_state_t&, const Receipt&) { ++received; });
  other.subscribe<head_state_t>([&](const head_state_t&, const Receipt&) { ++others; });
  for (Bus* bus : {&sender, &receiver, &other}) start(*bus);
  head_state_t head{};
  for (int i = 0; i < 20; ++i) REQUIRE(sender.publish(head));
  handle_until(receiver, [&] { return received == 20; });
  other.handle(milliseconds(50));
  CHECK(received == 20);
  CHECK(others == 0);
  CHECK(receiver.counters<head_state_t>().arrivals.lost == 0);
}

TEST_CASE("a burst of event packets is queued without loss") {
  if (!is_given_large_buffer()) {
    MESSAGE("skipped: net.core.rmem_max is too small here for a user without more rights");
    return;
  }
  const std::string url = private_lcm_url();
  Bus sender({.url = url});
  Bus receiver({.url = url});
  std::int64_t events = 0;
  receiver.subscribe<event_packet_t>(
      [&](const event_packet_t& packet, const Receipt&) { events += packet.count; });
  start(sender);
  start(receiver);
  EventPacker packer({.sensor = {640, 480}});
  const std::vector<Event> burst(3350, Event{.x = 1, .y = 2, .polarity = 1, .offset_us = 3});
  for (int i = 0; i < 50; ++i) {  // 500 packets while nobody reads: LCM's own queue holds 30.
    packer.pack({i}, burst, [&](event_packet_t& packet) { REQUIRE(sender.publish(packet)); });
    std::this_thread::sleep_for(milliseconds(1));
  }
  handle_until(receiver, [&] { return events == packer.events_packed(); });
  CHECK(events == 167500);
  CHECK(receiver.counters<event_packet_t>().arrivals.lost == 0);
  CHECK(receiver.counters<event_packet_t>().arrivals.items_lost == 0);
}

TEST_CASE("a receipt tells whether more messages are waiting") {
  for (const std::string& url : {std::string("memq://"), private_lcm_url()}) {
    CAPTURE(url);
    Bus bus({.url = url});
    std::vector<bool> more_waiting;
    bus.subscribe<head_state_t>([&](const head_state_t&, const Receipt& receipt) {
      more_waiting.push_back(receipt.more_waiting);
    });
    start(bus);
    for (int i = 0; i < 3; ++i) {
      head_state_t head{};
      REQUIRE(bus.publish(head));
    }
    handle_until(bus, [&] { return more_waiting.size() == 3; });
    CHECK(more_waiting == std::vector{true, true, false});
  }
}

TEST_CASE("unread packets wait in the socket up to its capacity") {
  if (!is_given_large_buffer()) {
    MESSAGE("skipped: net.core.rmem_max is too small here for a user without more rights");
    return;
  }
  const std::string url = private_lcm_url();
  Bus sender({.url = url});
  Bus receiver({.url = url});
  receiver.subscribe<event_packet_t>([](const event_packet_t&, const Receipt&) {});
  start(sender);
  start(receiver);
  const auto received = [&] { return receiver.counters<event_packet_t>().arrivals.received; };
  const auto publish_unread = [&](int packet_bytes, int packets) {
    EventPacker packer({.sensor = {640, 480}, .packet_bytes = packet_bytes});
    const std::vector<Event> events(static_cast<std::size_t>(packer.max_events()));
    for (int i = 0; i < packets; ++i) {
      packer.pack({i}, events, [&](event_packet_t& packet) { REQUIRE(sender.publish(packet)); });
      if (i % 4 == 0) std::this_thread::sleep_for(milliseconds(1));
    }
  };
  const auto handle_all = [&] {
    while (receiver.handle(milliseconds(50)) > 0) {
    }
  };
  // Twice the socket's buffer of 4 MB at most: unread packets wait there only.
  publish_unread(60'000, 1'000);
  handle_all();
  CHECK(received() > 0);
  CHECK(received() <= 140);

  const std::int64_t before = received();
  publish_unread(1472, 1500);
  handle_all();
  CHECK(received() - before > 700);
}

TEST_CASE("malformed messages on every channel are dropped and counted, good ones still arrive") {
  const std::string url = private_lcm_url();
  Bus bus({.url = url});
  std::array<int, kAllChannels.size()> received{};
  for (const Channel channel : kAllChannels) {
    with_message_type(channel, [&]<typename Message>(Message) {
      bus.subscribe<Message>([&received, channel](const Message&, const Receipt&) {
        ++received[static_cast<std::size_t>(channel)];
      });
    });
  }
  start(bus);
  Stranger stranger(url);
  std::mt19937_64 random(8);
  for (const Channel channel : kAllChannels) {
    CAPTURE(base_name(channel));
    const std::string name(base_name(channel));
    const auto good = random_message(channel, random).bytes;
    stranger.publish(name, {});
    stranger.publish(name, {1, 2, 3});
    auto bad = good;
    bad.pop_back();
    stranger.publish(name, bad);
    stranger.publish(name, good);
    const int& count = received[static_cast<std::size_t>(channel)];
    handle_until(bus, [&] { return count == 1; });
    CHECK(count == 1);
    CHECK(bus.counters(channel).rejected == 3);
    CHECK(bus.counters(channel).arrivals.received == 1);
    CHECK_FALSE(bus.counters(channel).last_rejection.empty());
  }
}

TEST_CASE("a message larger than its type's limit is dropped unread") {
  Bus bus({.url = private_lcm_url()});
  int received = 0;
  bus.subscribe<head_state_t>([&](const head_state_t&, const Receipt&) { ++received; });
  start(bus);
  Stranger stranger(private_lcm_url());
  stranger.publish("PUCK_HEAD", std::vector<std::uint8_t>(2000));
  handle_until(bus, [&] { return bus.counters<head_state_t>().oversize == 1; });
  CHECK(bus.counters<head_state_t>().oversize == 1);
  CHECK(bus.counters<head_state_t>().rejected == 0);
  CHECK(bus.counters<head_state_t>().last_rejection.starts_with(
      "has 2000 bytes, more than the 88 that its type can have, from "));
  CHECK(received == 0);
}

TEST_CASE("foreign datagrams are counted and named, and wake no thread") {
  const std::string url = private_lcm_url();
  Bus bus({.url = url, .prefix = "LEFT"});
  bus.subscribe<head_state_t>([](const head_state_t&, const Receipt&) {});
  start(bus);
  Stranger stranger(url);
  stranger.publish("RIGHT_PUCK_HEAD", {1});
  stranger.publish("RIGHT_PUCK_HEAD", {1});
  stranger.publish("LEFT_PUCK_GAME", {1});  // Ours, though nobody listens to it.
  CHECK(bus.handle(milliseconds(50)) == 0);
  handle_until(bus, [&] { return bus.network_counters().foreign == 2; });
  const TransportCounters network = bus.network_counters();
  CHECK(network.foreign == 2);
  REQUIRE(network.foreign_traffic.size() == 1);
  CHECK(network.foreign_traffic[0].what == "channel \"RIGHT_PUCK_HEAD\"");
  CHECK(network.foreign_traffic[0].datagrams == 2);
  CHECK(network.foreign_traffic[0].sender.address != 0);
}

TEST_CASE("a message in several datagrams is refused unless that is allowed") {
  const std::string url = private_lcm_url();
  Bus strict({.url = url});
  Bus generous({.url = url, .allow_fragments = true});
  std::size_t heard_strict = 0;
  std::size_t heard_generous = 0;
  const auto count_into = [](std::size_t& heard) {
    return [&heard](std::string_view, std::span<const std::uint8_t> bytes, const Receipt&) {
      heard += bytes.size();
    };
  };
  strict.subscribe_all(count_into(heard_strict));
  generous.subscribe_all(count_into(heard_generous));
  start(strict);
  start(generous);
  Stranger stranger(url);
  stranger.publish("PUCK_LARGE", std::vector<std::uint8_t>(200'000, 7));
  handle_until(generous, [&] { return heard_generous > 0; });
  handle_until(strict, [&] { return strict.network_counters().foreign >= 4; });
  CHECK(heard_generous == 200'000);
  CHECK(heard_strict == 0);
  REQUIRE_FALSE(strict.network_counters().foreign_traffic.empty());
  CHECK(strict.network_counters().foreign_traffic[0].what ==
        "message fragments (refused: "
        "lcm.allow_fragments is false)");
}

TEST_CASE("lost packets and events are counted from the packets' own counts") {
  const std::string url = private_lcm_url();
  Bus bus({.url = url});
  int received = 0;
  bus.subscribe<event_packet_t>([&](const event_packet_t&, const Receipt&) { ++received; });
  start(bus);
  Stranger camera(url);
  EventPacker packer({.sensor = {640, 480}});
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 5; ++i) {
    packer.pack({i}, std::vector<Event>(10), [&](event_packet_t& packet) {
      packet.session = 42;
      packet.seq = i;
      encode(packet, bytes);
      if (i != 2 && i != 3) camera.publish("PUCK_EVENTS", bytes);
    });
  }
  handle_until(bus, [&] { return received == 3; });
  const LossCounters arrivals = bus.counters<event_packet_t>().arrivals;
  CHECK(arrivals.received == 3);
  CHECK(arrivals.lost == 2);
  CHECK(arrivals.items_lost == 20);
}

TEST_CASE("a subscriber to all channels receives every channel of its prefix as bytes") {
  const std::string url = private_lcm_url();
  Bus bus({.url = url, .prefix = "LEFT"});
  std::vector<std::string> channels;
  std::size_t bytes_heard = 0;
  bus.subscribe_all(
      [&](std::string_view channel, std::span<const std::uint8_t> bytes, const Receipt& receipt) {
        channels.emplace_back(channel);
        bytes_heard += bytes.size();
        CHECK(receipt.bytes == bytes.size());
      });
  start(bus);
  Stranger stranger(url);
  stranger.publish("PUCK_EVENTS", {1});
  stranger.publish("RIGHT_PUCK_EVENTS", {1});
  stranger.publish("LEFT_PUCK_EVENTS", {1, 2});
  stranger.publish("LEFT_PUCK_NEW_THING", {1, 2, 3});
  head_state_t head{};
  bus.publish(head);
  handle_until(bus, [&] { return channels.size() == 3; });
  CHECK(channels ==
        std::vector<std::string>{"LEFT_PUCK_EVENTS", "LEFT_PUCK_NEW_THING", "LEFT_PUCK_HEAD"});
  CHECK(bytes_heard == 5 + static_cast<std::size_t>(head.getEncodedSize()));
}

TEST_CASE("threads may publish concurrently, and every number is used once") {
  Bus bus({.url = "memq://"});
  int received = 0;
  bus.subscribe<head_state_t>([&](const head_state_t&, const Receipt&) { ++received; });
  start(bus);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&bus] {
        for (int k = 0; k < 100; ++k) {
          head_state_t head{};
          bus.publish(head);
        }
      });
    }
  }
  handle_until(bus, [&] { return received == 400; });
  const LossCounters arrivals = bus.counters<head_state_t>().arrivals;
  CHECK(arrivals.received == 400);
  CHECK(arrivals.lost == 0);
  CHECK(arrivals.late == 0);
  CHECK(arrivals.duplicates == 0);
}

}  // namespace puck
