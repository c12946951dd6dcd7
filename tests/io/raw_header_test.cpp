#include "common/io/raw_header.h"

#include <span>
#include <stdexcept>

#include <doctest/doctest.h>

#include "common/io/event_stream.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

std::optional<RawHeader> parse(std::string_view text, bool is_all = true) {
  return parse_raw_header(std::as_bytes(std::span(text)), is_all);
}

TEST_CASE("a RAW header ends with its end line, or before the first line without a percent sign") {
  CHECK(parse("% evt 3.0\n% end\n% data")->length == 16);
  CHECK(parse("% evt 3.0\n\x25\x8b\x01\x60")->length == 10);
  CHECK(parse("% evt 3.0\n% \x01\x02\n")->length == 10);
  CHECK(parse("\x01\x02")->length == 0);
}

TEST_CASE("an unfinished RAW header requests more bytes") {
  for (const char* text : {"", "%", "% ", "% evt 3.0", "% evt 3.0\n", "% evt 3.0\n%"}) {
    CAPTURE(text);
    CHECK_FALSE(parse(text, false));
    CHECK(parse(text, true));
  }
  CHECK(parse("% evt 3.0\n\x01", false));
}

TEST_CASE("a RAW header gives encoding and sensor in the new form and the old") {
  const auto by_format = parse("% format EVT3;height=720;width=1280\n");
  CHECK(by_format->encoding() == "EVT3");
  CHECK(by_format->sensor() == SensorSize{1280, 720});
  const auto by_geometry = parse("% evt 2.0\r\n% geometry 346x260\r\n% system_ID 48\n");
  CHECK(by_geometry->encoding() == "EVT2");
  CHECK(by_geometry->sensor() == SensorSize{346, 260});
  CHECK(by_geometry->sensor_of_camera() == SensorSize{1280, 720});
  CHECK(parse("% evt 2.0\n% system_ID 21\n")->sensor_of_camera() == SensorSize{640, 480});
  CHECK_FALSE(parse("% evt 2.0\n% system_ID 9999\n")->sensor_of_camera());
  CHECK(parse("% evt 2.1\n% generation 4.2\n")->sensor_of_camera() == SensorSize{1280, 720});
  CHECK(parse("% evt 2.1\n% sensor_name GenX320\n")->sensor_of_camera() == SensorSize{320, 320});
  CHECK(parse("% format EVT21;endianness=legacy\n")->format_option("endianness") == "legacy");
  CHECK_FALSE(parse("% evt 2.0\n")->sensor());
  CHECK(parse("% made_by hand and foot\n")->value("made_by") == "hand and foot");
}

TEST_CASE("a RAW header with a malformed or contradictory geometry is refused") {
  for (const char* text :
       {"% geometry 640\n", "% geometry 640x\n", "% geometry 0x480\n", "% geometry 4096x480\n",
        "% format EVT3;width=640\n", "% format EVT3;width=640;height=x\n",
        "% format EVT3;width=640;height=480\n% geometry 640x481\n"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse(text)->sensor(), std::invalid_argument);
  }
}

std::string refusal_of_stream(std::string_view bytes, EventFileOptions options = {}) {
  return message_of<EventFileError>([&] {
    EventStream stream("stdin", options);
    EventPacket packet;
    stream.decode(std::as_bytes(std::span(bytes)), packet, 100);
    stream.finish();
  });
}

TEST_CASE("an incomplete description of a stream is refused with the option that completes it") {
  CHECK(contains(refusal_of_stream("% evt 3.0\nxx"), "stdin: does not say how large"));
  CHECK(contains(refusal_of_stream("% evt 3.0\nxx"), "--width"));
  CHECK(
      contains(refusal_of_stream("% evt 1.0\nxx"), "EVT 1.0; expected EVT2, EVT21, EVT3 or EVT4"));
  CHECK(contains(refusal_of_stream("\x01\x02"), "no Prophesee RAW header"));
  CHECK(contains(refusal_of_stream(""), "stdin: is empty"));
  CHECK(contains(refusal_of_stream("% evt 3.0\n% geometry 640x480\nxx", {.sensor = {1280, 720}}),
                 "640x480, the options that it is 1280x720"));
  CHECK(contains(refusal_of_stream("% evt 3.0\nxx", {.sensor = {4000, 1}}),
                 "from 1 x 1 to 2048 x 2048"));
}

TEST_CASE("a stream without a header needs the format and the size as options") {
  const auto bytes = bytes_of<std::uint16_t>({0x8000, 0x6001, 0x0002, 0x2803});
  EventStream stream("stdin", {.from = "evt3", .sensor = {640, 480}});
  EventPacket packet;
  CHECK(stream.decode(bytes, packet, 100) == bytes.size());
  REQUIRE(packet.events.size() == 1);
  CHECK(packet.time_of(packet.events[0]).us == 1);
  CHECK(packet.events[0].x == 3);
}

TEST_CASE("a stream may be divided anywhere, even in its header") {
  const std::string header = "% evt 3.0\n% geometry 640x480\n";
  auto bytes = bytes_of<std::uint16_t>({0x8000, 0x6001, 0x0002, 0x2803, 0x6002, 0x2804});
  std::vector<std::byte> whole(header.size());
  std::transform(header.begin(), header.end(), whole.begin(),
                 [](char c) { return static_cast<std::byte>(c); });
  whole.insert(whole.end(), bytes.begin(), bytes.end());
  for (std::size_t piece = 1; piece <= whole.size(); ++piece) {
    EventStream stream("test", {});
    std::vector<PlainEvent> events;
    EventPacket packet;
    for (std::size_t i = 0; i < whole.size();) {
      packet.events.clear();
      const std::size_t length = std::min(piece, whole.size() - i);
      i += stream.decode(std::span(whole).subspan(i, length), packet, 1);
      append_plain(packet, events);
    }
    while (stream.has_backlog()) {
      packet.events.clear();
      stream.decode({}, packet, 1);
      append_plain(packet, events);
    }
    CHECK(events == std::vector<PlainEvent>{{1, 3, 2, 1}, {2, 4, 2, 1}});
  }
}

}  // namespace
}  // namespace puck
