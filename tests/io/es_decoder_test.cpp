// No recording of an ATIS as Event Stream was to be had: its bytes are written from the
// specification.
#include "common/io/es_decoder.h"

#include <doctest/doctest.h>

#include "common/io/event_stream.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

std::string es_header(char type) {
  return std::string("Event Stream\x02\0\0", 15) + type + std::string("\x40\x01\xf0\0", 4);
}

// One event of a 320 × 240 sensor; y counts upwards.
std::string es_event(int first, int x, int y) {
  std::string text;
  for (const int byte : {first, x & 0xff, x >> 8, y & 0xff, y >> 8})
    text += static_cast<char>(byte);
  return text;
}

std::vector<PlainEvent> decode_es(const std::string& text, std::size_t piece, std::size_t most,
                                  EventCounters* counters = nullptr) {
  EventStream stream("test", {});
  std::vector<PlainEvent> events;
  EventPacket packet;
  const auto bytes = std::as_bytes(std::span(text));
  const auto feed = [&](std::span<const std::byte> part) {
    do {
      packet.events.clear();
      part = part.subspan(stream.decode(part, packet, most));
      append_plain(packet, events);
    } while (!part.empty() || stream.has_backlog());
  };
  for (std::size_t i = 0; i < bytes.size(); i += piece) {
    feed(bytes.subspan(i, std::min(piece, bytes.size() - i)));
  }
  stream.finish();
  feed({});
  if (counters != nullptr) *counters = stream.counters();
  return events;
}

TEST_CASE("Event Stream bytes of a DVS become events, wherever they are cut") {
  const std::string text = es_header(1) + es_event(7 << 1 | 1, 319, 239) + "\xff\xff\xfe" +
                           es_event(126 << 1, 5, 0) + es_event(0, 320, 0) + es_event(2, 0, 1);
  const std::vector<PlainEvent> expected{
      {7, 319, 0, 1}, {7 + 2 * 127 + 126, 5, 239, 0}, {388, 0, 238, 0}};
  for (std::size_t piece = 1; piece <= text.size(); ++piece) {
    for (const std::size_t most : {1, 100}) {
      EventCounters counters;
      CHECK(decode_es(text, piece, most, &counters) == expected);
      CHECK(counters.outside_sensor == 1);
    }
  }
}

TEST_CASE("Event Stream bytes of an ATIS become events without those of grey levels") {
  const std::string text = es_header(2) + es_event(5 << 2 | 2, 10, 20) +
                           es_event(1 << 2 | 1, 1, 1) + "\xff\xfc\xfd" + es_event(0, 11, 21);
  for (std::size_t piece = 1; piece <= text.size(); ++piece) {
    EventCounters counters;
    CHECK(decode_es(text, piece, 10, &counters) ==
          std::vector<PlainEvent>{{5, 10, 219, 1}, {6 + 3 * 63 + 63, 11, 218, 0}});
    CHECK(counters.other_data == 1);
  }
}

TEST_CASE("Event Stream files of other kinds are refused by name") {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    return message_of<EventFileError>([&] { open_event_file(folder.write("a.es", text)); });
  };
  CHECK(contains(refusal(es_header(4)), "of colour events; expected version 2, and DVS or ATIS"));
  CHECK(contains(refusal(es_header(9)), "of the unknown type 9"));
  CHECK(contains(refusal(std::string("Event Stream\x01\0\0\x01\x40\x01\xf0\0", 20)),
                 "of version 1.0"));
  CHECK(contains(refusal("Event Stream\x02"), "ends within its Event Stream header of 20 bytes"));
  CHECK(
      contains(refusal(std::string("Event Stream\x02\0\0\x01\0\0\0\0", 20)), "a sensor of 0 x 0"));
}

}  // namespace
}  // namespace puck
