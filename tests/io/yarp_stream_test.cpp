// Messages of an IIT camera's port give the events of a log of the same messages.
#include "common/io/yarp_stream.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/yarp_bottle.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"
#include "tests/support/recordings.h"
#include "tests/support/yarp_bottle_encoder.h"
#include "tests/support/yarp_log_encoder.h"

namespace puck {
namespace {

using namespace std::string_literals;

constexpr SensorSize kLeftEye{304, 240};

std::span<const std::uint8_t> in_bytes(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

void take_all(YarpStream& stream, std::vector<PlainEvent>& events) {
  EventPacket packet;
  while (stream.take(packet, 100)) append_plain(packet, events);
}

struct StreamedEvents {
  std::vector<PlainEvent> events;
  EventCounters counters;
};

StreamedEvents stream_all(const std::vector<WireBottle>& bottles, const EventFileOptions& options) {
  YarpStream stream("/eye", options);
  StreamedEvents streamed;
  for (const WireBottle& bottle : bottles) {
    stream.add(in_bytes(bottle.bytes), bottle.time_s);
    take_all(stream, streamed.events);
  }
  stream.finish();
  take_all(stream, streamed.events);
  streamed.counters = stream.counters();
  CHECK(stream.malformed_messages() == 0);
  return streamed;
}

std::string camera_log(YarpEncoding encoding, int packets) {
  std::mt19937 random(7);
  YarpLogEncoder encoder(encoding, {0}, 0x7fffffff - 30'000);
  for (int i = 0; i < packets; ++i) {
    std::vector<PlainEvent> events;
    for (int k = 0; k < 40; ++k) {
      events.push_back({i * 1000 + k * 20, static_cast<int>(random() % 310),
                        static_cast<int>(random() % 240), static_cast<int>(random() % 2)});
    }
    encoder.add(packet_of(events), 1000, i % 7 != 0);
  }
  return encoder.text();
}

void check_as_log(const std::string& log, const EventFileOptions& options) {
  const TemporaryFolder folder;
  std::ofstream(folder / "data.log", std::ios::binary) << log;
  const auto reader = open_event_file(folder / "data.log", options);
  const auto expected = read_all(*reader);
  CHECK(expected.size() > 1000);
  const StreamedEvents streamed = stream_all(wire_bottle::of_log(log), options);
  CHECK(streamed.events == expected);
  CHECK(streamed.counters.outside_sensor == reader->counters().outside_sensor);
  CHECK(streamed.counters.other_data == reader->counters().other_data);
  CHECK(streamed.counters.malformed_words == reader->counters().malformed_words);
}

std::string bottle_of(const std::string& items, std::int64_t count) {
  return wire_bottle::list_of(static_cast<std::size_t>(count)) + items;
}

bool parse(const std::string& bottle, YarpPacket& packet) {
  return parse_yarp_bottle(in_bytes(bottle), packet);
}

const std::string kTwoWords = "\1\0\0\0\2\0\0\0"s;

}  // namespace

TEST_CASE("a port's messages give the events of a log of them, in each form of the records") {
  for (const YarpEncoding encoding :
       {YarpEncoding::kList, YarpEncoding::kStamped, YarpEncoding::kPlain}) {
    CAPTURE(static_cast<int>(encoding));
    check_as_log(camera_log(encoding, 100), {.sensor = kLeftEye});
    check_as_log(camera_log(encoding, 200), {.sensor = kLeftEye, .yarp_eye = "left"});
  }
}

TEST_CASE("a real camera's log gives the same events as messages") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  std::ifstream file(*recordings / "real_ball" / "bouncing_ball_atis_304x240.yarp.log");
  const std::string log{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  check_as_log(log, {.sensor = kLeftEye});
}

TEST_CASE("events wait for a sample of messages, or until the form is decided") {
  const auto bottles = wire_bottle::of_log(camera_log(YarpEncoding::kStamped, 60));
  YarpStream stream("/eye", {.sensor = kLeftEye, .reorder_us = 0});
  std::vector<PlainEvent> events;
  for (int i = 0; i < YarpStream::kSampleMessages; ++i) {
    CHECK(events.empty());
    CHECK(stream.is_undecided() == (i > 0));
    stream.add(in_bytes(bottles[static_cast<std::size_t>(i)].bytes), 1 + i * 1e-3);
    take_all(stream, events);
  }
  CHECK(events.size() > 1000);
  CHECK_FALSE(stream.is_undecided());

  YarpStream slow("/eye", {.sensor = kLeftEye, .reorder_us = 0});
  slow.add(in_bytes(bottles[1].bytes), 1);
  slow.add(in_bytes(bottles[2].bytes), 1.001);
  slow.decide();
  events.clear();
  take_all(slow, events);
  CHECK(events.size() > 60);
}

TEST_CASE("a port's stream needs the sensor's size") {
  CHECK_THROWS_WITH(YarpStream("/eye", {}), doctest::Contains("does not say how large the sensor"));
}

TEST_CASE("messages that are no events are counted, and the next ones are read") {
  const auto bottles = wire_bottle::of_log(camera_log(YarpEncoding::kStamped, 40));
  YarpStream stream("/eye", {.sensor = kLeftEye});
  const std::vector<std::string> wrong{"",
                                       "x",
                                       "hello, this is no bottle",
                                       bottle_of("", 0),
                                       bottle_of(wire_bottle::int32(1), 1),
                                       bottles[0].bytes.substr(0, bottles[0].bytes.size() - 1),
                                       bottles[0].bytes + "x"};
  for (const std::string& message : wrong) stream.add(in_bytes(message), 1);
  CHECK(stream.malformed_messages() == static_cast<std::int64_t>(wrong.size()));
  for (const double sent_s : {-1.0, 1e12, std::nan("")}) {
    stream.add(in_bytes(bottles[0].bytes), sent_s);
  }
  CHECK(stream.malformed_messages() == static_cast<std::int64_t>(wrong.size()) + 3);
  for (const WireBottle& bottle : bottles) stream.add(in_bytes(bottle.bytes), bottle.time_s);
  stream.finish();
  std::vector<PlainEvent> events;
  take_all(stream, events);
  CHECK(events.size() > 1000);
}

TEST_CASE("a bottle's events are read from a list, a string and a blob, beside other records") {
  YarpPacket packet;
  const std::string tag = wire_bottle::string_item("AE");
  REQUIRE(parse(bottle_of(tag + wire_bottle::int_list({5, -6, 7}), 2), packet));
  CHECK(packet.words == std::vector<std::uint32_t>{5, 0xfffffffa});
  CHECK_FALSE(packet.is_bytes);
  CHECK(packet.malformed_values == 1);

  const std::string duration = "\1\0\0\0\x10\x27\0\0"s;
  const std::string blob = "\xC\0\0\0\x8\0\0\0"s + kTwoWords;
  const std::string imu = wire_bottle::string_item("IMUS") + wire_bottle::int_list({1, 2});
  REQUIRE(parse(bottle_of(imu + tag + duration + blob + imu, 7), packet));
  CHECK(packet.words == std::vector<std::uint32_t>{1, 2});
  CHECK(packet.is_bytes);
  CHECK(packet.duration_us == 10'000);
  CHECK(packet.other_records == 2);
  CHECK(packet.malformed_values == 0);

  // Bytes that look like a tag, a tag with its NUL, and bytes that are no whole word.
  REQUIRE(parse(
      bottle_of(wire_bottle::string_item("AE\0"s) + duration + wire_bottle::string_item("ABCDEFG"),
                3),
      packet));
  CHECK(packet.words == std::vector<std::uint32_t>{0x44434241});
  CHECK(packet.malformed_values == 1);
  CHECK(packet.other_records == 0);

  // A tag without events.
  REQUIRE(parse(bottle_of(tag + duration, 2), packet));
  CHECK(packet.malformed_values == 1);
  REQUIRE(parse(bottle_of(tag + wire_bottle::list_of(0), 2), packet));
  CHECK(packet.malformed_values == 0);
}

TEST_CASE("sizes in a bottle are not trusted") {
  YarpPacket packet;
  const std::string tag = wire_bottle::string_item("AE");
  const std::string deep = [] {
    std::string lists;
    for (int i = 0; i < 100'000; ++i) lists += wire_bottle::list_of(1);
    return lists;
  }();
  CHECK_FALSE(parse(wire_bottle::list_of(0x7fffffff) + tag, packet));
  CHECK_FALSE(parse(bottle_of(tag + "\1\1\0\0\xFF\xFF\xFF\x7F"s, 2), packet));
  CHECK_FALSE(parse(bottle_of(tag + "\1\1\0\0\xFF\xFF\xFF\xFF"s, 2), packet));
  CHECK_FALSE(parse(bottle_of("\4\0\0\0\xFF\xFF\xFF\x7F"s, 1), packet));
  CHECK_FALSE(parse(bottle_of("\x63\0\0\0\1\0\0\0"s, 1), packet));
  CHECK_FALSE(parse(deep, packet));
}

}  // namespace puck
