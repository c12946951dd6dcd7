#include "common/io/text_event_reader.h"

#include <doctest/doctest.h>

#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

constexpr SensorSize kTextSensor{240, 180};

std::vector<PlainEvent> read_text(std::string_view text, EventFileOptions options = {}) {
  const TemporaryFolder folder;
  options.sensor = kTextSensor;
  return read_all(*open_event_file(folder.write("events.txt", text), options));
}

std::string refusal_of_text(std::string_view text, EventFileOptions options = {}) {
  return message_of<EventFileError>([&] { read_text(text, options); });
}

const std::vector<PlainEvent> kTwoEvents{{1500029, 61, 31, 1}, {1500038, 59, 32, 0}};

TEST_CASE("text events are seconds with a decimal point, else µs") {
  CHECK(read_text("1.500029 61 31 1\n1.500038 59 32 0\n") == kTwoEvents);
  CHECK(read_text("1500029 61 31 1\n1500038 59 32 0\n") == kTwoEvents);
  CHECK(read_text("2 61 31 1\n", {.text_unit = "s"}) ==
        std::vector<PlainEvent>{{2000000, 61, 31, 1}});
  CHECK(read_text("2.4 61 31 1\n", {.text_unit = "us"}) == std::vector<PlainEvent>{{2, 61, 31, 1}});
}

TEST_CASE("text times are rounded to the µs, even late ones") {
  CHECK(read_text("1699999999.123456 1 2 1\n")[0].t_us == 1699999999123456);
  CHECK(read_text("0.0000005 1 2 1\n")[0].t_us == 1);
}

TEST_CASE("text columns may come in any order and with any separator") {
  CHECK(read_text("61,31,1,1500029\n59,32,0,1500038\n", {.text_columns = "x,y,p,t"}) == kTwoEvents);
  CHECK(read_text("x,y,p,t\n61,31,1,1500029\n59,32,0,1500038\n") == kTwoEvents);
  CHECK(read_text("1.500029\t61  31;1\r\n 1.500038 , 59 , 32 , 0 \r\n") == kTwoEvents);
  CHECK(read_text("1500029|61|31|1\n1500038|59|32|-1\n", {.text_separator = "|"}) == kTwoEvents);
}

TEST_CASE("comments and empty lines are skipped") {
  CHECK(read_text("# made by hand\n% t x y p\n\n1500029 61 31 1\n# more\n1500038 59 32 0") ==
        kTwoEvents);
}

TEST_CASE("a text file may give its sensor's size") {
  const TemporaryFolder folder;
  const auto path = folder.write("events.csv", "%geometry:320,200\n1 2 3 1\n");
  CHECK(open_event_file(path)->sensor_size() == SensorSize{320, 200});
  CHECK(contains(message_of<EventFileError>([&] {
                   open_event_file(path, {.sensor = {1, 1}});
                 }),
                 "disagree"));
  CHECK(contains(message_of<EventFileError>(
                     [&] { open_event_file(folder.write("bad.csv", "%geometry:320\n1 2 3 1\n")); }),
                 "bad.csv:1: expected %geometry:WIDTH,HEIGHT"));
  CHECK(contains(
      message_of<EventFileError>([&] { open_event_file(folder.write("none.csv", "1 2 3 1\n")); }),
      "--width"));
}

TEST_CASE("a bad line is refused with file and line, and the expected form") {
  for (const char* line : {"1500038 59 32", "1500038 59 32 1 7", "1500038 59 32 2", "x 59 32 1",
                           "1500038 5.5 32 1", "-3 59 32 1", "nan 59 32 1", "1e300 1 1 1"}) {
    CAPTURE(line);
    const std::string message =
        refusal_of_text("# comment\n1500029 61 31 1\n" + std::string(line) + "\n");
    CHECK(contains(message, "events.txt:3: expected `t x y p`"));
    CHECK(contains(message, line));
  }
}

TEST_CASE("malformed text options are refused") {
  CHECK(contains(refusal_of_text("1 2 3 1\n", {.text_columns = "t x y"}), "the columns must be"));
  CHECK(contains(refusal_of_text("1 2 3 1\n", {.text_columns = "t x y y"}), "got \"t x y y\""));
  CHECK(contains(refusal_of_text("1 2 3 1\n", {.text_unit = "ms"}), "must be auto, s or us"));
  CHECK(contains(refusal_of_text("1 2 3 1\n", {.text_separator = "--"}),
                 "must be auto or one character"));
}

TEST_CASE("text events outside the sensor or back in time are left out and counted") {
  const TemporaryFolder folder;
  const auto reader = open_event_file(
      folder.write("events.txt", "5 0 0 1\n5 240 0 1\n5 0 180 1\n5 -1 0 1\n4 0 0 1\n6 70000 1 1\n"),
      {.sensor = kTextSensor});
  CHECK(read_all(*reader) == std::vector<PlainEvent>{{5, 0, 0, 1}});
  CHECK(reader->counters().outside_sensor == 4);
  CHECK(reader->counters().backwards == 1);
  CHECK(reader->warnings().size() == 2);
}

TEST_CASE("a truncated text file gives all whole events and a warning") {
  const TemporaryFolder folder;
  const auto reader =
      open_event_file(folder.write("cut.txt", "1 2 3 1\n2 4"), {.sensor = kTextSensor});
  CHECK(read_all(*reader).size() == 1);
  CHECK(reader->counters().truncated_bytes == 3);
  CHECK(contains(reader->warnings().at(0), "cut.txt: cut off"));
}

TEST_CASE("a byte order mark before the first line is skipped") {
  const TemporaryFolder folder;
  const auto reader =
      open_event_file(folder.write("a.txt", "\xef\xbb\xbf%geometry:240,180\n1 2 3 1\n"));
  CHECK(read_all(*reader) == std::vector<PlainEvent>{{1, 2, 3, 1}});
}

TEST_CASE("times in s are recognised even if the first one is a whole number") {
  CHECK(contains(refusal_of_text("0 2 3 1\n0.25 2 3 1\n", {.text_unit = "auto"}),
                 ":2: expected whole µs, because the first time has no decimal point"));
  const TemporaryFolder folder;
  const auto reader = open_event_file(folder.write("a.txt", "0 2 3 1\n0.25 2 3 1\n"),
                                      {.sensor = kTextSensor, .text_unit = "s"});
  CHECK(read_all(*reader) == std::vector<PlainEvent>{{0, 2, 3, 1}, {250000, 2, 3, 1}});
}

}  // namespace
}  // namespace puck
