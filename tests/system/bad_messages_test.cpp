// Anybody can send anything on the bus: the services count it, and go on.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <lcm/lcm.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/messaging/channels.h"
#include "common/messaging/lcm_url.h"
#include "tests/support/random_message.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/system_bench.h"

namespace puck {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes random_bytes(std::size_t size, std::mt19937_64& random) {
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

/// Every way to be wrong once.
std::vector<Bytes> malformed(Channel channel, std::mt19937_64& random) {
  const RandomMessage good = random_message(channel, random);
  std::vector<Bytes> bad;
  bad.push_back({});
  bad.push_back(random_bytes(random() % 2000 + 1, random));
  bad.push_back(Bytes(good.bytes.begin(),
                      good.bytes.begin() + static_cast<long>(random() % good.bytes.size())));
  Bytes& too_long = bad.emplace_back(good.bytes);
  too_long.push_back(0);
  Bytes& other_type = bad.emplace_back(good.bytes);
  other_type[random() % 8] ^= static_cast<std::uint8_t>(random() % 255 + 1);
  for (const std::size_t offset : good.count_offsets) {
    for (const std::uint8_t first : {0x7f, 0xff}) {
      Bytes& huge = bad.emplace_back(good.bytes);
      std::fill_n(huge.begin() + static_cast<long>(offset), 4, 0xff);
      huge[offset] = first;
    }
  }
  return bad;
}

/// Talks plain LCM, unchecked.
class RawPublisher {
 public:
  explicit RawPublisher(const std::string& url) : lcm_(lcm_create(url.c_str()), lcm_destroy) {}

  void publish(const std::string& channel, const Bytes& bytes) {
    REQUIRE(lcm_ != nullptr);
    lcm_publish(lcm_.get(), channel.c_str(), bytes.data(), static_cast<unsigned>(bytes.size()));
  }

 private:
  std::unique_ptr<lcm_t, decltype(&lcm_destroy)> lcm_;
};

/// Datagrams that are no LCM at all, to the group and port of a bus.
void send_datagrams(const std::string& url, int count, std::mt19937_64& random) {
  const LcmUrl bus = parse_lcm_url(url);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(bus.port));
  inet_pton(AF_INET, bus.group.c_str(), &to.sin_addr);
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  REQUIRE(socket >= 0);
  const std::uint8_t ttl = 0;
  setsockopt(socket, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
  for (int i = 0; i < count; ++i) {
    const Bytes bytes = random_bytes(random() % 1400, random);
    sendto(socket, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to),
           sizeof to);
  }
  close(socket);
}

}  // namespace

TEST_CASE("malformed messages on all channels are counted by all services, and stop none") {
  const TemporaryFolder folder;
  const std::string url = new_lcm_url();
  BusListener bus(url);
  std::vector<std::unique_ptr<ChildProcess>> services;
  for (const std::string name : {"puck-logger", "puck-tracker", "puck-bridge", "puck-arm"}) {
    std::vector<std::string> settings;
    if (name == "puck-logger") settings = {"logger.path=" + (folder / "a.lcm").string()};
    services.push_back(
        std::unique_ptr<ChildProcess>(new ChildProcess(start_service(name, url, settings))));
  }
  REQUIRE(bus.hears({"puck-logger", "puck-tracker", "puck-bridge", "puck-arm"}));
  services.push_back(
      std::unique_ptr<ChildProcess>(new ChildProcess(start_service("puck-camera", url))));
  REQUIRE(bus.until([&] {
    return bus.fresh_estimates() > 50 && bus.counter("puck-arm", "commands_accepted") > 5;
  }));

  std::mt19937_64 random(1);
  RawPublisher publisher(url);
  std::int64_t sent_a_channel = 0;
  constexpr int kRounds = 30;
  for (int round = 0; round < kRounds; ++round) {
    for (const Channel channel : kAllChannels) {
      const std::vector<Bytes> messages = malformed(channel, random);
      for (const Bytes& bytes : messages) publisher.publish(channel_name(channel, ""), bytes);
      if (channel == Channel::kStatus) sent_a_channel += static_cast<std::int64_t>(messages.size());
    }
    send_datagrams(url, 5, random);
    // Paced, so that none is lost; and the listener must not fall behind.
    bus.until([] { return false; }, std::chrono::milliseconds(10));
  }

  // All hear STATUS, and each at least one channel more.
  for (const char* name : {"puck-tracker", "puck-bridge", "puck-arm", "puck-camera"}) {
    CAPTURE(name);
    CHECK(bus.until(
        [&] { return bus.counter(name, "messages_rejected") > sent_a_channel + kRounds; }));
  }
  CHECK(
      bus.until([&] { return bus.counter("puck-logger", "messages_rejected") >= sent_a_channel; }));
  CHECK(bus.until([&] { return bus.counter("puck-logger", "packets_rejected") >= kRounds; }));

  const std::int64_t estimates = bus.fresh_estimates();
  const std::int64_t commands = bus.counter("puck-arm", "commands_accepted");
  const std::int64_t written = bus.counter("puck-logger", "messages_written");
  CHECK(bus.until([&] { return bus.fresh_estimates() > estimates + 50; }));
  CHECK(bus.until([&] { return bus.counter("puck-arm", "commands_accepted") > commands + 20; }));
  CHECK(bus.until([&] { return bus.counter("puck-logger", "messages_written") > written + 50; }));
  CHECK(bus.counter("puck-tracker", "events_lost") == 0);
  for (auto& service : services) {
    CHECK(service->is_running());
    service->send(SIGTERM);
    CHECK(service->wait_for(std::chrono::seconds(10)) == 0);
  }
}

}  // namespace puck
