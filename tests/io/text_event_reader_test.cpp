#include <array>
#include <cstdio>

#include <doctest/doctest.h>

#include "common/io/event_reader.h"
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
                 "320x200, the options that it is 1x1"));
  CHECK(contains(message_of<EventFileError>(
                     [&] { open_event_file(folder.write("bad.csv", "%geometry:320\n1 2 3 1\n")); }),
                 "bad.csv:1: expected %geometry:WIDTH,HEIGHT"));
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
  CHECK(contains(refusal_of_text("1 2 3 1\n", {.text_unit = "min"}),
                 "must be auto, s, ms, us or ns"));
  CHECK(contains(refusal_of_text("1 2 3 1\n", {.text_separator = "--"}),
                 "must be auto or one character"));
}

TEST_CASE("text events outside the sensor or back in time are left out and counted") {
  const TemporaryFolder folder;
  const auto reader = open_event_file(
      folder.write(
          "events.txt",
          "5005 0 0 1\n5005 240 0 1\n5005 0 180 1\n5005 -1 0 1\n4004 0 0 1\n5006 70000 1 1\n"),
      {.sensor = kTextSensor});
  CHECK(read_all(*reader) == std::vector<PlainEvent>{{5005, 0, 0, 1}});
  CHECK(reader->counters().outside_sensor == 4);
  CHECK(reader->counters().backwards == 1);
  CHECK(reader->warnings().size() == 2);
}

TEST_CASE("numbers may be quoted") {
  CHECK(read_text("\"1500029\",\"61\",\"31\",\"1\"\n\"1500038\",\"59\",\"32\",\"0\"\n") ==
        kTwoEvents);
  CHECK(read_text("\"t\";\"x\";\"y\";\"p\"\n\"1.500029\";\"61\";\"31\";\"1\"\r\n"
                  "\"1.500038\"; \"59\"; \"32\"; \"-1\"\r\n") == kTwoEvents);
}

TEST_CASE("a first line of two numbers before lines of four is the sensor's size") {
  const TemporaryFolder folder;
  const std::string text = "240 180\n1500029 61 31 1\n1500038 59 32 0\n";
  const auto reader = open_event_file(folder.write("sized.txt", text));
  CHECK(reader->sensor_size() == kTextSensor);
  CHECK(read_all(*reader) == kTwoEvents);
  // Joined, the second begins another part.
  const auto joined = open_event_file(folder.write("joined.txt", text + text));
  CHECK(read_all(*joined).size() == 4);
  CHECK(joined->counters().backwards == 0);
  CHECK(contains(joined->warnings().at(0), "another header at byte"));

  CHECK(contains(refusal_of_text("240 180\n61 31\n"), "got \"240 180\""));
  CHECK(contains(refusal_of_text("0 180\n1500029 61 31 1\n"), "got \"0 180\""));
  CHECK(contains(refusal_of_text("240 180\n"), "got \"240 180\""));
}

TEST_CASE("of two texts joined without a header the line of the second's start is told") {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 400; ++i) text += std::to_string(1000 + 10'001 * i) + " 1 2 1\n";
  const auto reader =
      open_event_file(folder.write("joined.txt", text + text), {.sensor = kTextSensor});
  CHECK(read_all(*reader).size() == 401);
  CHECK(
      contains(reader->warnings().at(0),
               "joined.txt: the times go back at line 401 by 3.9904 s: are two recordings joined"));
}

TEST_CASE("a truncated text file gives all whole events and a warning") {
  const TemporaryFolder folder;
  const auto reader =
      open_event_file(folder.write("cut.txt", "1 2 3 1\n2 4"), {.sensor = kTextSensor});
  CHECK(read_all(*reader).size() == 1);
  CHECK(reader->counters().truncated_bytes == 3);
  CHECK(contains(reader->warnings().at(0), "cut.txt: cut off"));
}

TEST_CASE("names with blanks and columns without a value are read where another separator stands") {
  const std::vector<PlainEvent> events{{1'000'001, 2, 3, 1}, {1'000'031, 4, 5, 0}};
  CHECK(read_text("Time (us),X,Y,Polarity\n1000001,2,3,1\n1000031,4,5,0\n") == events);
  CHECK(read_text("x;y;note;p;t\n2;3;a first one;1;1000001\n4;5;;0;1000031\n") == events);
  CHECK(read_text("t,x,y,p,\n1000001,2,3,1,\n1000031,4,5,0,\n") == events);
}

TEST_CASE("a byte order mark before the first line is skipped") {
  const TemporaryFolder folder;
  const auto reader =
      open_event_file(folder.write("a.txt", "\xef\xbb\xbf%geometry:240,180\n1 2 3 1\n"));
  CHECK(read_all(*reader) == std::vector<PlainEvent>{{1, 2, 3, 1}});
  const auto plain = open_event_file(folder.write("b.txt",
                                                  "\xef\xbb\xbf"
                                                  "1000000 2 3 1\n2000000 4 5 0\n"),
                                     {.sensor = {240, 180}});
  EventPacket both;
  REQUIRE(plain->read(both, 10));
  CHECK(both.events.size() == 2);
}

TEST_CASE("times in s are recognised even if the first one is a whole number") {
  CHECK(read_text("0 2 3 1\n0.25 2 3 1\n") ==
        std::vector<PlainEvent>{{0, 2, 3, 1}, {250000, 2, 3, 1}});
}

TEST_CASE("a text's columns are taken from their names, wherever they stand") {
  for (const char* header :
       {"timestamp,x,y,polarity", "# t x y p", "\"t\" \"x\" \"y\" \"p\"", "T;X;Y;POL"}) {
    CAPTURE(header);
    CHECK(read_text(std::string(header) + "\n1500029 61 31 1\n1500038 59 32 0\n") == kTwoEvents);
  }
  CHECK(read_text("x y pol ts\n61 31 1 1500029\n59 32 -1 1500038\n") == kTwoEvents);
  CHECK(read_text("index,y,x,label,p,time[s]\n0,31,61,a,1,1.500029\n1,32,59,b,0,1.500038\n") ==
        kTwoEvents);
  CHECK(read_text("t_ns,x,y,on\n1500029000,61,31,true\n1500038000,59,32,False\n") == kTwoEvents);
  CHECK(read_text("time_ms,x,y,p\n1500.029,61,31,1\n1500.038,59,32,0\n") == kTwoEvents);
  CHECK(contains(refusal_of_text("t,x,y\n1,2,3\n"), ":1: expected the names of columns"));
  const TemporaryFolder folder;
  CHECK(open_event_file(folder.write("size.csv", "t,x@640,y@480,on\n1,2,3,1\n"))->sensor_size() ==
        SensorSize{640, 480});
}

TEST_CASE("the order x y p t is recognised without names") {
  CHECK(read_text("61,31,1,1500029\n59,32,0,1500038\n") == kTwoEvents);
}

TEST_CASE("pixels and polarities may have decimals, and all numbers an exponent") {
  CHECK(read_text("1.500029 61.000000 31.0 1.000000\n1.500038 59. 32.0 -1.0\n") == kTwoEvents);
  CHECK(read_text("1.500029e+00 6.1e+01 3.1e+01 1e+00\n1.500038e+00 5.9e+01 3.2e1 0.0e+00\n") ==
        kTwoEvents);
}

// `count` events, 10 µs apart, their times written by `write`.
template <typename Write>
std::string many_lines(int count, Write write) {
  std::string text;
  for (int i = 0; i < count; ++i) text += write(i * 10) + " " + std::to_string(i % 240) + " 3 1\n";
  return text;
}

TEST_CASE("the unit of a text's times is inferred where only one is possible") {
  const auto span_us = [](const std::string& text) {
    const auto events = read_text(text);
    return events.back().t_us - events.front().t_us;
  };
  const auto in_us = [](int us) { return std::to_string(1'000'000 + us); };
  CHECK(span_us(many_lines(1001, in_us)) == 10'000);
  const auto in_s = [](int us) { return "1." + std::to_string(1'000'000 + us).substr(1) + "000"; };
  CHECK(span_us(many_lines(1001, in_s)) == 10'000);
  // As µs these would lie beyond any clock.
  const auto in_ns = [](int us) { return std::to_string(1'700'000'000'000'000 + us) + "000"; };
  CHECK(span_us(many_lines(1001, in_ns)) == 10'000);
}

TEST_CASE("a text's unit is asked for where two are possible, with the reasons") {
  // 3 s of events, whose µs were written as floats.
  std::string floats;
  for (int i = 0; i < 300'000; ++i) floats += std::to_string(i * 10) + ".0 5 3 1\n";
  const std::string refusal = refusal_of_text(floats);
  CHECK(contains(refusal, "0.1 events a second over 35 days"));
  CHECK(contains(refusal, "is the unit us?"));
  CHECK(contains(refusal, "us (100000 events a second over 3 s)"));
  CHECK(contains(refusal, "--unit"));
  CHECK(read_text(floats, {.text_unit = "us"}).back().t_us == 2'999'990);
  // ms as numpy.savetxt writes them by default.
  const auto as_savetxt = [](int us) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.18e", us * 1e-3);
    return std::string(text.data());
  };
  CHECK(contains(refusal_of_text(many_lines(1000, as_savetxt)), "give the unit"));
  // Whole ms in ns, or in µs.
  const auto in_thousands = [](int us) { return std::to_string(us * 1000); };
  CHECK(contains(refusal_of_text(many_lines(1000, in_thousands)), "give the unit"));
}

TEST_CASE("a text that is cut within a number at its end loses that event alone") {
  const std::string text = "x,y,p,t\n61,31,1,1500029\n59,32,0,1500038";
  CHECK(read_text(text) == kTwoEvents);
  for (std::size_t cut = 1; cut < 16; ++cut) {
    CAPTURE(cut);
    CHECK(read_text(text.substr(0, text.size() - cut)) ==
          std::vector<PlainEvent>{kTwoEvents.front()});
  }
}

}  // namespace
}  // namespace puck
