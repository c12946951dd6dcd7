#include <doctest/doctest.h>

#include "common/io/event_reader.h"
#include "common/io/event_writer.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

const std::string kHeader = "% evt 3.0\n% geometry 640x480\n% end\n";

std::string text_of(const std::vector<std::byte>& bytes) {
  std::string text;
  for (const std::byte byte : bytes) text += static_cast<char>(byte);
  return text;
}

std::string refusal_of_file(const std::filesystem::path& path,
                            const EventFileOptions& options = {}) {
  return message_of<EventFileError>([&] { open_event_file(path, options); });
}

TEST_CASE("a missing, empty or foreign file and a folder are refused in one line") {
  const TemporaryFolder folder;
  CHECK(contains(refusal_of_file(folder / "none.raw"), "none.raw: cannot be opened: No such file"));
  CHECK(contains(refusal_of_file(folder / ""), "is a folder"));
  CHECK(contains(refusal_of_file(folder.write("empty.raw", "")), "empty.raw: is empty; expected"));
  CHECK(contains(refusal_of_file(folder.write("a.png", "\x89PNG\r\n\x1a\nxxxx")),
                 "a.png: is a PNG image"));
  CHECK(contains(refusal_of_file(folder.write("a.aedat", "#!AER-DAT3.1\r\nxx")),
                 "is an AEDAT 3 file"));
  CHECK(contains(refusal_of_file(folder.write("a.bag", "#ROSBAG V2.0\n")), "is a ROS bag"));
  CHECK(contains(refusal_of_file(folder.write("a.raw", "\x01\x02\x03\x04")),
                 "has no Prophesee RAW header"));
  CHECK(contains(refusal_of_file(folder.write("a.bin", "\x01\x02\x03\x04")),
                 "is of an unknown format"));
  CHECK(contains(refusal_of_file(folder.write("b.raw", kHeader), {.from = "evt9"}),
                 "must be one of evt2, evt21, evt3, evt4, "));
  for (const char* name : {"empty.raw", "a.png", "a.raw"}) {
    CHECK(refusal_of_file(folder / name).find('\n') == std::string::npos);
  }
}

TEST_CASE("a truncated RAW file gives all whole events and a warning") {
  const TemporaryFolder folder;
  const std::string words =
      text_of(bytes_of<std::uint16_t>({0x8000, 0x6001, 0x0002, 0x2803, 0x2804}));
  const auto path = folder.write("cut.raw", kHeader + words.substr(0, words.size() - 1));
  const auto reader = open_event_file(path);
  CHECK(read_all(*reader) == std::vector<PlainEvent>{{1, 3, 2, 1}});
  CHECK(reader->counters().truncated_bytes == 1);
  REQUIRE(reader->warnings().size() == 1);
  CHECK(contains(reader->warnings()[0], "cut.raw: cut off in the middle"));
}

TEST_CASE("a RAW file that ends within or right after its header is reported") {
  const TemporaryFolder folder;
  CHECK(contains(refusal_of_file(folder.write("half.raw", "% evt 3.0\n% geome")),
                 "how large the sensor"));
  const auto reader = open_event_file(folder.write("bare.raw", kHeader));
  EventPacket packet;
  CHECK_FALSE(reader->read(packet, 10));
  CHECK(contains(reader->warnings().at(0), "holds no events"));
}

TEST_CASE("events outside the sensor are left out and counted") {
  const TemporaryFolder folder;
  const std::string words = text_of(bytes_of<std::uint16_t>({0x8000, 0x0002, 0x2a80, 0x2804}));
  const auto reader = open_event_file(folder.write("out.raw", kHeader + words));
  CHECK(read_all(*reader).size() == 1);
  CHECK(reader->counters().outside_sensor == 1);
  CHECK(contains(reader->warnings().at(0), "1 events lie outside the sensor"));
}

TEST_CASE("a file can be read again after rewind, with the same counts") {
  const TemporaryFolder folder;
  const std::string words =
      text_of(bytes_of<std::uint16_t>({0x8000, 0x0002, 0x2a80, 0x2804, 0x2805}));
  const auto reader = open_event_file(folder.write("again.raw", kHeader + words));
  const auto events = read_all(*reader, 1);
  REQUIRE(events.size() == 2);
  for (int i = 0; i < 2; ++i) {
    reader->rewind();
    CHECK(read_all(*reader) == events);
    CHECK(reader->counters().events == 2);
    CHECK(reader->counters().outside_sensor == 1);
  }
}

// Times at the borders of EVT3's words, pauses and a wrap; places at the borders of its vectors.
std::vector<PlainEvent> hard_events(SensorSize sensor, std::int64_t start_us) {
  std::vector<PlainEvent> events;
  std::int64_t t_us = start_us;
  for (const std::int64_t pause_us :
       {0, 0, 1, 4095, 4096, 1, 8192, 16777216, 16777215, 40000000, 3}) {
    t_us += pause_us;
    events.push_back({t_us, 0, 0, 1});
    events.push_back({t_us, sensor.width - 1, sensor.height - 1, 0});
    // Two rows of a vector's length and more, of both polarities, with holes.
    for (int x = 0; x < sensor.width && x < 70; ++x) {
      if (x % 7 != 3) events.push_back({t_us, x, sensor.height / 2, x / 33 % 2});
    }
    // The same pixel twice, and columns that fall.
    events.push_back({t_us, 5 % sensor.width, 0, 1});
    events.push_back({t_us, 5 % sensor.width, 0, 1});
    events.push_back({t_us, 4 % sensor.width, 0, 1});
    // The last columns, where a vector reaches beyond the sensor.
    for (int x = std::max(0, sensor.width - 20); x < sensor.width; ++x) {
      events.push_back({t_us, x, 0, 1});
    }
  }
  return events;
}

TEST_CASE("a file whose content was replaced is not read on after a failed rewind") {
  const TemporaryFolder folder;
  std::vector<PlainEvent> events;
  for (int i = 0; i < 50'000; ++i) events.push_back({i * 50, i % 64, i % 48, 1});
  for (const std::string name : {"a.raw", "a.aedat4"}) {
    CAPTURE(name);
    const auto writer = make_event_writer(folder / name, "", {64, 48});
    writer->write(packet_of(events));
    writer->close();
    const auto reader = open_event_file(folder / name);
    CHECK(reader->can_rewind());
    EventPacket packet;
    REQUIRE(reader->read(packet, 1));
    folder.write(name, "no events");
    CHECK_THROWS_AS(reader->rewind(), EventFileError);
    CHECK_THROWS_AS(read_all(*reader), EventFileError);
  }
}

TEST_CASE("written events are read back to the bit") {
  const TemporaryFolder folder;
  for (const WrittenFormat& format : kWrittenFormats) {
    const std::string name(format.name);
    for (const SensorSize sensor :
         {SensorSize{1, 1}, SensorSize{346, 260}, SensorSize{1280, 720}, SensorSize{2048, 2048}}) {
      for (const std::int64_t start_us : {0, 1, 4096, 16777215, 43499029}) {
        CAPTURE(name);
        CAPTURE(sensor.width);
        CAPTURE(start_us);
        const std::vector<PlainEvent> events = hard_events(sensor, start_us);
        const auto writer = make_event_writer(folder / name, name, sensor);
        // In packets that divide rows and vectors.
        for (std::size_t i = 0; i < events.size(); i += 13) {
          const auto first = events.begin() + static_cast<std::ptrdiff_t>(i);
          const auto last =
              events.begin() + static_cast<std::ptrdiff_t>(std::min(i + 13, events.size()));
          writer->write(packet_of({first, last}));
        }
        writer->close();
        const auto reader = open_event_file(folder / name);
        CHECK(reader->sensor_size() == sensor);
        CHECK(read_all(*reader, 100) == events);
        CHECK(reader->warnings().empty());
      }
    }
  }
}

TEST_CASE("dense rows are written as vectors") {
  const TemporaryFolder folder;
  std::vector<PlainEvent> events;
  for (int x = 0; x < 640; ++x) events.push_back({0, x, 0, 1});
  const auto writer = make_event_writer(folder / "dense.raw", "evt3", {640, 480});
  writer->write(packet_of(events));
  writer->close();
  // Time, row, and four words for each 32 pixels.
  const std::string content = read_text(folder / "dense.raw");
  const std::size_t words = (content.size() - content.find("% end\n") - 6) / 2;
  CHECK(words <= 5 + 4 * 20);
}

TEST_CASE("a writer refuses invalid events") {
  const TemporaryFolder folder;
  CHECK(contains(message_of<EventFileError>([&] {
                   make_event_writer(folder / "none/a.raw", "", {1, 1});
                 }),
                 "cannot be opened for writing: No such file"));
  CHECK(contains(message_of<EventFileError>([&] {
                   make_event_writer(folder / "a.x", "", {1, 1});
                 }),
                 "expected .raw, .dat, .hdf5, .aedat4, .es, .csv, .txt, .h5, or the format as"));
  CHECK(contains(message_of<EventFileError>([&] {
                   make_event_writer(folder / "a.raw", "evt9", {1, 1});
                 }),
                 "must be one of evt3, evt2, evt21, dat, hdf5, hdf5-ecf, aedat4, es, csv, text, "
                 "got \"evt9\""));
  CHECK(contains(message_of<EventFileError>([&] {
                   make_event_writer(folder / "a.raw", "", {0, 1});
                 }),
                 "from 1 x 1 to 2048 x 2048"));
  for (const char* name : {"a.raw", "a.txt"}) {
    const auto writer = make_event_writer(folder / name, "", {10, 10});
    writer->write(packet_of({{100, 9, 9, 1}}));
    CHECK_THROWS_AS(writer->write(packet_of({{100, 10, 9, 1}})), std::invalid_argument);
    CHECK_THROWS_AS(writer->write(packet_of({{99, 9, 9, 1}})), std::invalid_argument);
  }
  const auto writer = make_event_writer(folder / "b.raw", "", {10, 10});
  CHECK_THROWS_AS(writer->write(packet_of({{std::int64_t{25} * 3600 * 1000000, 9, 9, 1}})),
                  std::invalid_argument);
}

TEST_CASE("a full disk is reported when the writer is closed") {
  if (!std::filesystem::exists("/dev/full")) return;
  const auto writer = make_event_writer("/dev/full", "text", {10, 10});
  writer->write(packet_of({{100, 9, 9, 1}}));
  CHECK(contains(message_of<EventFileError>([&] { writer->close(); }),
                 "/dev/full: cannot be written: No space left"));
}

}  // namespace
}  // namespace puck
