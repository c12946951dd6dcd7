#include "common/messaging/message_fields.h"

#include <charconv>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/messaging/byte_reader.h"
#include "common/messaging/message_codec.h"
#include "common/messaging/wire_layout.h"
#include "tests/support/random_message.h"

namespace puck {
namespace {

/// One line a value: `name[index]=value`.
std::vector<std::string> lines_of(Channel channel, const std::vector<std::uint8_t>& bytes) {
  std::vector<std::string> lines;
  visit_fields(
      channel, bytes,
      [&](std::string_view name, std::optional<std::size_t> index, std::string_view value) {
        std::string line(name);
        if (index) line += "[" + std::to_string(*index) + "]";
        lines.push_back(line.append("=").append(value));
      });
  return lines;
}

template <typename Message>
std::vector<std::string> lines_of(Message message) {
  std::vector<std::uint8_t> bytes;
  encode(message, bytes);
  REQUIRE(check_message(kChannelOf<Message>, bytes) == std::nullopt);
  return lines_of(kChannelOf<Message>, bytes);
}

}  // namespace

TEST_CASE("a message's fields are shown with name and value, in the order of the type") {
  service_status_t status{};
  status.utime = 1'700'000'000'000'001;
  status.session = 7;
  status.service = "puck-camera";
  status.host = "robot";
  status.state = service_status_t::STATE_RUNNING;
  status.counter_name = {"events sent", "x"};
  status.counter_value = {-5, 1LL << 62};
  CHECK(lines_of(status) ==
        std::vector<std::string>{
            "utime=1700000000000001", "session=7", "seq=0", "service=puck-camera", "host=robot",
            "pid=0", "version=", "state=1", "state_text=", "uptime_us=0", "counter_count=2",
            "counter_name[0]=events sent", "counter_name[1]=x", "counter_value[0]=-5",
            "counter_value[1]=4611686018427387904", "latency_count=0", "pong_count=0"});
}

TEST_CASE(
    "numbers are written in the shortest form that reads back the same, booleans as 0 and 1") {
  arm_command_t command{};
  command.session = 1;
  command.from_operator = 1;
  command.target_m = 0.1;
  command.target_normalised = -1.0 / 3;
  const auto lines = lines_of(command);
  CHECK(lines[4] == "from_operator=1");
  CHECK(lines[5] == "target_m=0.1");
  CHECK(lines[6] == "target_normalised=-0.3333333333333333");
}

TEST_CASE("elements of an array of fixed length have an index each, bytes are one value") {
  puck_estimate_t estimate{};
  estimate.session = 1;
  estimate.covariance[15] = 2.5;
  int covariances = 0;
  for (const std::string& line : lines_of(estimate)) covariances += line.starts_with("covariance[");
  CHECK(covariances == 16);

  event_packet_t packet{};
  packet.session = 1;
  packet.width = 640;
  packet.height = 480;
  packet.encoding = event_packet_t::ENCODING_X10_Y9_DT12;
  packet.count = 1;
  packet.data = {0x00, 0x10, 0x0a, 0x01};
  CHECK(lines_of(packet).back() == "data=00100a01");
}

TEST_CASE("every type is shown completely, and each value reads back") {
  std::mt19937_64 random(7);
  for (const Channel channel : kAllChannels) {
    CAPTURE(wire_layout(channel).type);
    for (int i = 0; i < 50; ++i) {
      const auto bytes = random_message(channel, random).bytes;
      std::size_t seen_bytes = 8;  // The fingerprint.
      visit_fields(channel, bytes,
                   [&](std::string_view name, std::optional<std::size_t>, std::string_view value) {
                     const auto& fields = wire_layout(channel).fields;
                     const auto field =
                         std::find_if(fields.begin(), fields.end(),
                                      [&](const WireField& known) { return known.name == name; });
                     REQUIRE(field != fields.end());
                     const auto at = std::span(bytes).subspan(seen_bytes);
                     switch (field->kind) {
                       case WireKind::kString:
                         seen_bytes += 4 + value.size() + 1;
                         break;
                       case WireKind::kByte:
                         seen_bytes += value.size() / 2;
                         break;
                       case WireKind::kDouble: {
                         double number = 0;
                         std::from_chars(value.data(), value.data() + value.size(), number);
                         REQUIRE(number == ByteReader(at).real());
                         seen_bytes += 8;
                         break;
                       }
                       case WireKind::kInt64:
                         REQUIRE(value == std::to_string(ByteReader(at).whole<std::int64_t>()));
                         seen_bytes += 8;
                         break;
                       case WireKind::kInt32:
                         REQUIRE(value == std::to_string(ByteReader(at).whole<std::int32_t>()));
                         seen_bytes += 4;
                         break;
                       case WireKind::kInt8:
                       case WireKind::kBoolean:
                         REQUIRE(value == std::to_string(ByteReader(at).whole<std::int8_t>()));
                         seen_bytes += 1;
                         break;
                     }
                   });
      REQUIRE(seen_bytes == bytes.size());
    }
  }
}

}  // namespace puck
