#include "common/io/aedat4_reader.h"

#include <cstring>

#include <doctest/doctest.h>

#include "common/io/event_writer.h"
#include "tests/io/event_data.h"
#include "tests/io/gzip_text.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

std::string aedat4_of(const TemporaryFolder& folder, const std::vector<PlainEvent>& events) {
  const auto writer = make_event_writer(folder / "made.aedat4", "", {64, 48});
  writer->write(packet_of(events));
  writer->close();
  return read_text(folder / "made.aedat4");
}

std::size_t number_at(const std::string& bytes, std::size_t place) {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

// Where the packets begin.
std::size_t header_end(const std::string& bytes) { return 18 + number_at(bytes, 14); }

TEST_CASE("AEDAT4 of an independent encoder has the simulator's events") {
  for (const char* name :
       {"simulated_none.aedat4", "simulated_lz4.aedat4", "simulated_zstd.aedat4"}) {
    CAPTURE(name);
    const auto reader = open_event_file(event_data(name));
    CHECK(reader->sensor_size() == SensorSize{320, 240});
    CHECK(digest_of(*reader) == kSimulatedDigest);
    CHECK(reader->warnings().empty());
    reader->rewind();
    CHECK(digest_of(*reader, 7) == kSimulatedDigest);
  }
}

TEST_CASE("AEDAT4 that is cut off anywhere gives its whole packets, or an error in one line") {
  const TemporaryFolder folder;
  // Three packets, the last one short.
  const auto events = scattered_events(33000);
  const std::string whole = aedat4_of(folder, events);
  const std::size_t first = header_end(whole);
  const std::size_t second = first + 8 + number_at(whole, first + 4);
  const std::size_t third = second + 8 + number_at(whole, second + 4);
  REQUIRE(third + 8 + number_at(whole, third + 4) == whole.size());
  for (std::size_t length = 0; length < whole.size(); length += length < 700 ? 1 : 1009) {
    CAPTURE(length);
    const auto path = folder.write("cut.aedat4", whole.substr(0, length));
    if (length < first) {
      const std::string message = message_of<EventFileError>([&] { open_event_file(path); });
      CHECK_FALSE(message.empty());
      CHECK(message.find('\n') == std::string::npos);
      continue;
    }
    const auto reader = open_event_file(path);
    const std::size_t count = read_all(*reader).size();
    CHECK(count == (length < second ? 0 : length < third ? 16384 : 32768));
    const std::size_t begun = length < second ? first : length < third ? second : third;
    CHECK(reader->counters().truncated_bytes == static_cast<std::int64_t>(length - begun));
  }
}

TEST_CASE("AEDAT4: a damaged packet costs its events, a packet of another stream is counted") {
  const TemporaryFolder folder;
  const auto events = scattered_events(33000);
  std::string bytes = aedat4_of(folder, events);
  const std::size_t first = header_end(bytes);
  const std::size_t second = first + 8 + number_at(bytes, first + 4);
  bytes[first + 8] ^= 1;
  const auto damaged = open_event_file(folder.write("damaged.aedat4", bytes));
  CHECK(read_all(*damaged).size() == 33000 - 16384);
  CHECK(damaged->counters().malformed_words == 1);
  CHECK(contains(damaged->warnings().back(),
                 "packet at byte " + std::to_string(first + 8) + ": damaged LZ4"));

  bytes[first + 8] ^= 1;
  bytes[second] = 5;
  const auto other = open_event_file(folder.write("other.aedat4", bytes));
  CHECK(read_all(*other).size() == 33000 - 16384);
  CHECK(other->counters().other_data == 1);
}

TEST_CASE("AEDAT4: a wrong header is refused with what was expected") {
  const TemporaryFolder folder;
  const std::string whole = aedat4_of(folder, scattered_events(10));
  const auto refusal = [&](std::size_t place, const std::string& with) {
    std::string bytes = whole;
    bytes.replace(place, with.size(), with);
    return message_of<EventFileError>(
        [&] { open_event_file(folder.write("wrong.aedat4", bytes)); });
  };
  CHECK(contains(refusal(22, "IOHA"), "begins \"IOHA\", expected IOHE"));
  CHECK(contains(refusal(18, "\xff\xff\xff\x7f"), "an offset of"));
  CHECK(contains(refusal(14, "\xff\xff\xff\x7f"), "expected up to 16 MiB"));
  CHECK(contains(refusal(whole.find("EVTS"), "FRME"), "none of events; expected one of type EVTS"));
  CHECK(contains(refusal(whole.find("sizeX"), "sizeQ"), "from 1 x 1 to 2048 x 2048"));
  // Compression 9.
  CHECK(contains(refusal(18 + 28, "\x09"), "compression 9, expected 0 (none)"));
}

TEST_CASE("AEDAT4: a packet of an absurd size ends the reading with a word on it") {
  const TemporaryFolder folder;
  std::string bytes = aedat4_of(folder, scattered_events(10));
  bytes += std::string("\0\0\0\0\xff\xff\xff\xff", 8);
  const auto reader = open_event_file(folder.write("long.aedat4", bytes));
  CHECK(read_all(*reader).size() == 10);
  CHECK(contains(reader->warnings().back(), "claims 4294967295 bytes"));
}

TEST_CASE("AEDAT4: a second file behind the first is left out with a word on where it begins") {
  const TemporaryFolder folder;
  // Of our writer: packets to the end; of another, with an index behind the packets.
  const std::string plain = aedat4_of(folder, scattered_events(10));
  const std::string indexed = read_text(event_data("simulated_lz4.aedat4"));
  for (const auto& [first, between] :
       {std::pair(plain, std::string()), std::pair(indexed, std::string()),
        std::pair(indexed, std::string(65500, '#'))}) {
    const auto alone = open_event_file(folder.write("alone.aedat4", first));
    const std::size_t count = read_all(*alone).size();
    CHECK(alone->warnings().empty());
    const auto joined = open_event_file(folder.write("joined.aedat4", first + between + plain));
    CHECK(read_all(*joined).size() == count);
    REQUIRE(joined->warnings().size() == 1);
    CHECK(contains(joined->warnings()[0], "another AEDAT4 header at byte " +
                                              std::to_string(first.size() + between.size()) + ","));
    joined->rewind();
    CHECK(read_all(*joined).size() == count);
    CHECK(joined->warnings().size() == 1);
  }
}

TEST_CASE("AEDAT4 in gzip: damage behind the last packet is told, after all events") {
  const TemporaryFolder folder;
  const std::string plain = aedat4_of(folder, scattered_events(10));
  const std::string indexed = read_text(event_data("simulated_lz4.aedat4"));
  for (const auto& [bytes, count] : {std::pair(plain, 10), std::pair(indexed, 200)}) {
    const std::string packed = gzip(bytes);
    const auto read_packed = [&, events = count](const std::string& content) {
      const auto reader = open_event_file(folder.write("a.aedat4.gz", content));
      std::vector<PlainEvent> all;
      EventPacket packet;
      const std::string message = message_of<EventFileError>([&] {
        while (reader->read(packet, 1000)) append_plain(packet, all);
      });
      CHECK(all.size() == static_cast<std::size_t>(events));
      return message;
    };
    CHECK(read_packed(packed).empty());
    // The checksum, the length, and nothing of both.
    std::string damaged = packed;
    damaged[packed.size() - 8] ^= 1;
    CHECK(contains(read_packed(damaged), "no valid gzip data (incorrect data check)"));
    damaged = packed;
    damaged[packed.size() - 1] ^= 1;
    CHECK(contains(read_packed(damaged), "no valid gzip data (incorrect length check)"));
    CHECK(contains(read_packed(packed.substr(0, packed.size() - 8)), "end too early"));
  }
}

}  // namespace
}  // namespace puck
