#include "common/messaging/wire_layout.h"

#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/environment.h"
#include "tests/support/random_message.h"

namespace puck {
namespace {

const WireField& field(Channel channel, std::string_view name) {
  for (const WireField& each : wire_layout(channel).fields) {
    if (each.name == name) return each;
  }
  throw std::invalid_argument("no such field: " + std::string(name));
}

std::vector<std::string_view> meanings(Channel channel, std::string_view name) {
  const auto& values = field(channel, name).meanings;
  return {values.begin(), values.end()};
}

}  // namespace

TEST_CASE("every type in lcmtypes has a channel") {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_folder() / "lcmtypes")) {
    if (entry.path().extension() == ".lcm") ++files;
  }
  CHECK(files == kAllChannels.size());
}

TEST_CASE("a field has the range of its declaration, or the usual one of its type") {
  struct Expected {
    Channel channel;
    std::string_view field;
    std::int64_t min;
    std::int64_t max;
  };
  constexpr std::int64_t kMostInt64 = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t kLeastInt64 = std::numeric_limits<std::int64_t>::min();
  for (const Expected& expected : std::vector<Expected>{
           {Channel::kEvents, "utime", 0, kMostOnWire},
           {Channel::kEvents, "session", 1, kMostInt64},
           {Channel::kEvents, "width", 1, 2048},
           {Channel::kEvents, "first_event_us", 0, kMostOnWire - 4095},
           {Channel::kEvents, "duration_us", 0, 4095},
           {Channel::kEvents, "recorded", 0, 1},
           {Channel::kEvents, "encoding", 1, 3},
           {Channel::kEvents, "count", 0, 16384},
           {Channel::kEvents, "size", 0, 4 * 16384},
           {Channel::kEstimate, "events_session", 0, kMostInt64},
           {Channel::kEstimate, "state", 0, 2},
           {Channel::kEstimate, "flags", 0, 31},
           {Channel::kEstimate, "region_x", -2147483647, 2147483647},
           {Channel::kEstimate, "region_width", 0, 2147483647},
           {Channel::kEstimate, "image_height", 0, 2048},
           {Channel::kTrajectory, "path_length", 0, 4096},
           {Channel::kArmState, "reason", 0, 255},
           {Channel::kArmState, "joint_count", 0, 64},
           {Channel::kHead, "sensor_us", -1, kMostOnWire},
           {Channel::kCameraControl, "mode", 0, 4},
           {Channel::kCameraControl, "position_us", 0, kMostOnWire},
           {Channel::kCameraControl, "step_us", 0, kMostOnWire},
           {Channel::kStatus, "counter_count", 0, 256},
           {Channel::kStatus, "counter_value", kLeastInt64, kMostInt64},
           {Channel::kStatus, "latency_max_us", kLeastInt64, kMostInt64},
           {Channel::kStatus, "latency_samples", 0, kMostOnWire},
           {Channel::kStatus, "pong_count", 0, 64},
       }) {
    CAPTURE(expected.field);
    CHECK(field(expected.channel, expected.field).min == expected.min);
    CHECK(field(expected.channel, expected.field).max == expected.max);
  }
}

TEST_CASE("an array has its length, or the field with its length") {
  CHECK(field(Channel::kEstimate, "covariance").fixed_count == 16);
  CHECK(field(Channel::kStatus, "latency_p50_us").count_field == "latency_count");
  CHECK(field(Channel::kStatus, "pid").count_field.empty());
}

TEST_CASE("the values of a state, mode or phase have their names of lcmtypes") {
  using Names = std::vector<std::string_view>;
  CHECK(meanings(Channel::kEstimate, "state") == Names{"searching", "tracking", "lost"});
  CHECK(meanings(Channel::kArmCommand, "mode") == Names{"follow", "hold", "stop", "reset"});
  CHECK(meanings(Channel::kCameraControl, "mode") ==
        Names{"pause", "resume", "step", "seek", "speed"});
  CHECK(meanings(Channel::kGame, "phase") ==
        Names{"waiting", "rally", "shot at robot", "goal", "puck stuck", "puck out of view"});
  CHECK(meanings(Channel::kEstimate, "flags").empty());
}

TEST_CASE("every channel has the layout of its type") {
  for (const Channel channel : kAllChannels) {
    with_message_type(channel, [&]<typename Message>(Message) {
      CHECK(kChannelOf<Message> == channel);
      CHECK(wire_layout(channel).type == Message::getTypeName());
      CHECK(wire_layout(channel).fingerprint() == Message::getHash());
    });
  }
}

TEST_CASE("every layout consumes exactly the output of the generated encoder") {
  std::mt19937_64 random(1);
  for (const Channel channel : kAllChannels) {
    CAPTURE(wire_layout(channel).type);
    for (int i = 0; i < 200; ++i) {
      const auto bytes = random_structure(channel, random).bytes;
      with_message_type(channel, [&](auto message) {
        // Written in the layout, read and written again by LCM's code.
        const int size = static_cast<int>(bytes.size());
        REQUIRE(message.decode(bytes.data(), 0, size) == size);
        std::vector<std::uint8_t> again(static_cast<std::size_t>(message.getEncodedSize()));
        message.encode(again.data(), 0, static_cast<int>(again.size()));
        REQUIRE(again == bytes);
      });
      if (channel != Channel::kEvents) REQUIRE(check_message(channel, bytes) == std::nullopt);
    }
  }
}

}  // namespace puck
