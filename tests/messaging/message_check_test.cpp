#include <limits>

#include <doctest/doctest.h>

#include "common/messaging/event_packing.h"
#include "common/messaging/wire_layout.h"
#include "tests/support/random_message.h"

namespace puck {
namespace {

/// Bytes that passed the check must be unchanged by LCM's own code.
void check_honest(Channel channel, const std::vector<std::uint8_t>& bytes) {
  with_message_type(channel, [&](auto message) {
    REQUIRE(decode(bytes, message) == std::nullopt);
    std::vector<std::uint8_t> again;
    encode(message, again);
    REQUIRE(again == bytes);
  });
}

void put_int32(std::vector<std::uint8_t>& bytes, std::size_t offset, std::int32_t value) {
  for (int i = 0; i < 4; ++i) {
    bytes[offset + static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> (24 - 8 * i));
  }
}

/// A packet of two events for a test to modify.
event_packet_t two_events() {
  event_packet_t packet{};
  const std::vector<Event> events{{.x = 3, .y = 4, .polarity = 1, .offset_us = 0},
                                  {.x = 639, .y = 479, .polarity = 0, .offset_us = 7}};
  EventPacker packer({.sensor = {640, 480}});
  packer.pack({1000}, events, [&](event_packet_t& packed) { packet = packed; });
  packet.session = 1;
  return packet;
}

template <typename Message>
std::string rejection_of(Message message) {
  std::vector<std::uint8_t> bytes;
  encode(message, bytes);
  return check_message(kChannelOf<Message>, bytes).value_or("");
}

}  // namespace

TEST_CASE("a valid message of every type passes") {
  std::mt19937_64 random(2);
  for (const Channel channel : kAllChannels) {
    CAPTURE(wire_layout(channel).type);
    check_honest(channel, random_message(channel, random).bytes);
  }
}

TEST_CASE("a truncated message is rejected, and so is one with extra bytes") {
  std::mt19937_64 random(3);
  for (const Channel channel : kAllChannels) {
    CAPTURE(wire_layout(channel).type);
    auto bytes = random_message(channel, random).bytes;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      // A copy, so that the address sanitizer sees a read beyond the end.
      const std::vector<std::uint8_t> part(bytes.begin(),
                                           bytes.begin() + static_cast<std::ptrdiff_t>(length));
      REQUIRE(check_message(channel, part).has_value());
    }
    bytes.push_back(0);
    CHECK(check_message(channel, bytes) ==
          std::string(wire_layout(channel).type) + " has 1 bytes too many");
  }
}

TEST_CASE("a message with a flipped bit is rejected or still valid") {
  std::mt19937_64 random(4);
  for (const Channel channel : kAllChannels) {
    CAPTURE(wire_layout(channel).type);
    const auto bytes = random_message(channel, random).bytes;
    int rejected = 0;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      auto flipped = bytes;
      flipped[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
      if (check_message(channel, flipped)) {
        ++rejected;
      } else {
        check_honest(channel, flipped);
      }
    }
    CHECK(rejected >= 64);  // Each bit of the fingerprint at least.
  }
}

TEST_CASE("random bytes after a correct fingerprint are rejected or valid") {
  std::mt19937_64 random(5);
  for (const Channel channel : kAllChannels) {
    CAPTURE(wire_layout(channel).type);
    const auto good = random_message(channel, random).bytes;
    for (int i = 0; i < 2000; ++i) {
      std::vector<std::uint8_t> bytes(8 + random() % 400);
      for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
      std::copy(good.begin(), good.begin() + 8, bytes.begin());
      if (!check_message(channel, bytes)) check_honest(channel, bytes);
    }
  }
}

TEST_CASE("impossible counts are rejected") {
  std::mt19937_64 random(6);
  for (const Channel channel : kAllChannels) {
    CAPTURE(wire_layout(channel).type);
    const RandomMessage message = random_message(channel, random);
    for (const std::size_t offset : message.count_offsets) {
      // 0x20000000 doubles: the size wraps to 0 in 32 bits.
      for (const std::int32_t count :
           {-1, std::numeric_limits<std::int32_t>::min(), 0x20000000, 0x40000000,
            std::numeric_limits<std::int32_t>::max(), 4097}) {
        auto bytes = message.bytes;
        put_int32(bytes, offset, count);
        REQUIRE(check_message(channel, bytes).has_value());
      }
    }
  }
}

TEST_CASE("a message larger than any of ours is rejected before decoding") {
  const std::vector<std::uint8_t> bytes((1U << 20) + 1);
  CHECK(check_message(Channel::kHead, bytes) == "head_state_t is too large");
}

TEST_CASE("the fingerprint of another type is rejected") {
  std::mt19937_64 random(7);
  const auto head = random_message(Channel::kHead, random).bytes;
  CHECK(check_message(Channel::kGame, head) ==
        "game_state_t is expected, but this is head_state_t");
}

TEST_CASE("undefined values are rejected, and the reason names the field") {
  head_state_t head{};
  head.session = 1;
  CHECK(rejection_of(head).empty());
  head.roll_deg = std::numeric_limits<double>::quiet_NaN();
  CHECK(rejection_of(head) == "head_state_t.roll_deg is not a finite number");
  head.roll_deg = 0;
  head.session = 0;
  CHECK(rejection_of(head) == "head_state_t.session must be 1 to 9223372036854775807, got 0");

  arm_command_t command{};
  command.session = 1;
  command.mode = 4;
  CHECK(rejection_of(command) == "arm_command_t.mode must be 0 to 3, got 4");

  service_status_t status{};
  status.session = 1;
  status.service = "puck\x1b[2J";
  CHECK(rejection_of(status) == "service_status_t.service has a control character");
  status.service = std::string(256, 'a');
  CHECK(rejection_of(status) == "service_status_t.service has a length of 257");
}

TEST_CASE("contradictory event packets are rejected") {
  CHECK(rejection_of(two_events()).empty());

  auto packet = two_events();
  packet.width = 639;
  CHECK(rejection_of(packet) == "event_packet_t has an event outside its sensor");
  packet = two_events();
  packet.height = 479;
  CHECK(rejection_of(packet) == "event_packet_t has an event outside its sensor");
  packet = two_events();
  packet.height = 513;
  CHECK(rejection_of(packet) == "event_packet_t has a sensor too large for its encoding");
  packet = two_events();
  packet.width = 2049;
  CHECK(rejection_of(packet) == "event_packet_t.width must be 1 to 2048, got 2049");
  packet = two_events();
  packet.duration_us = 6;
  CHECK(rejection_of(packet) == "event_packet_t has an event after its duration");
  packet = two_events();
  std::swap_ranges(packet.data.begin(), packet.data.begin() + 4, packet.data.begin() + 4);
  CHECK(rejection_of(packet) == "event_packet_t has events that go back in time");
  packet = two_events();
  packet.count = 1;
  CHECK(rejection_of(packet) == "event_packet_t.size must be 4 * count = 4, got 8");
  packet = two_events();
  packet.encoding = 0;
  CHECK(rejection_of(packet) == "event_packet_t.encoding must be 1 to 3, got 0");
}

TEST_CASE("counts in messages equal the arrays' lengths, the shortest where arrays share a count") {
  puck_trajectory_t trajectory{};
  trajectory.session = 1;
  trajectory.path_length = 1000;
  trajectory.path_t_s = {0, 1, 2};
  trajectory.path_x_m = {0, 1, 2};
  trajectory.path_y_m = {0, 1};
  CHECK(rejection_of(trajectory).empty());
  set_counts(trajectory);
  CHECK(trajectory.path_length == 2);
  CHECK(trajectory.path_t_s.size() == 2);
}

}  // namespace puck
