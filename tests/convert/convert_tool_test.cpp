// The real puck-convert.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "common/io/event_writer.h"
#include "common/recording/recording.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/child_process.h"
#include "tests/support/contains.h"
#include "tests/support/environment.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

namespace fs = std::filesystem;

constexpr SensorSize kSensor{64, 48};

Finished convert(std::vector<std::string> arguments, const ChildOptions& options = {}) {
  arguments.insert(arguments.begin(), program_path("puck-convert"));
  return run_program(arguments, options);
}

std::vector<PlainEvent> many_events() {
  std::vector<PlainEvent> events;
  for (int i = 0; i < 50000; ++i) {
    events.push_back({20'000 + i / 2 * 3, i * 7 % 64, i * 5 % 48, i / 3 % 2});
  }
  return events;
}

std::string write_recording(const fs::path& path, const std::vector<PlainEvent>& events) {
  const auto writer = make_event_writer(path, "", kSensor);
  // One by one where a packet's offsets might not suffice.
  if (events.size() < 100) {
    for (const PlainEvent& event : events) writer->write(packet_of({event}));
  } else {
    writer->write(packet_of(events));
  }
  writer->close();
  return path.string();
}

std::vector<PlainEvent> events_in(const fs::path& path) {
  return read_all(*open_recording(path, {}, ""));
}

bool has_part_left(const TemporaryFolder& folder) {
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    if (contains(entry.path().filename().string(), ".part")) return true;
  }
  return false;
}

TEST_CASE("puck-convert goes from each format to the next and loses nothing") {
  const TemporaryFolder folder;
  const auto events = many_events();
  std::string from = write_recording(folder / "start.raw", events);
  std::vector<std::string> formats{"lcm"};
  for (const WrittenFormat& format : kWrittenFormats) formats.emplace_back(format.name);
  for (const std::string& format : formats) {
    CAPTURE(format);
    const std::string to = (folder / ("to_" + format)).string();
    const Finished finished = convert({from, to, "--to", format});
    CHECK(finished.exit_code == 0);
    CHECK(contains(finished.output, "50000 events read, 50000 written; left out: none"));
    CHECK(finished.errors.empty());
    CHECK(events_in(to) == events);
    from = to;
  }
}

TEST_CASE("puck-convert reads stdin and writes stdout") {
  const TemporaryFolder folder;
  const auto events = many_events();
  const std::string start = write_recording(folder / "start.raw", events);
  for (const char* format : {"hdf5", "aedat4", "lcm", "csv"}) {
    CAPTURE(format);
    const Finished first = convert({"-", "-", "--to", format}, {.input = start});
    CHECK(first.exit_code == 0);
    CHECK(contains(first.errors, "50000 written"));
    write_text(folder / "middle", first.output);
    const Finished second = convert({"-", "-", "--to", "evt3"}, {.input = folder / "middle"});
    CHECK(second.exit_code == 0);
    CHECK(second.output == read_text(start));
  }
}

TEST_CASE("puck-convert cuts, crops, turns and masks, and says what it left out") {
  const TemporaryFolder folder;
  const std::string start = write_recording(
      folder / "start.raw", {{100, 0, 0, 1}, {200, 1, 1, 0}, {300, 2, 1, 1}, {400, 9, 9, 1}});
  folder.write("mask.toml", "[pixel_mask]\nwidth = 64\nheight = 48\npixels = [2, 1]\n");
  const Finished finished = convert({start, (folder / "part.csv").string(), "--start", "0.0001",
                                     "--crop", "1,1,4,4", "--rotate-180", "--hot-pixel-mask",
                                     (folder / "mask.toml").string(), "--start-at-zero"});
  CHECK(finished.exit_code == 0);
  CHECK(contains(finished.output,
                 "4 events read, 1 written; left out: 1 before --start, 1 of masked pixels, 1 "
                 "outside the crop"));
  CHECK(read_text(folder / "part.csv") == "%geometry:4,4\nt,x,y,p\n0,3,3,0\n");
}

TEST_CASE("puck-convert filters events, and mirrors, rotates and undistorts the picture") {
  const TemporaryFolder folder;
  const std::string start = write_recording(folder / "start.raw", {{100, 9, 9, 1},
                                                                   {200, 1, 2, 1},
                                                                   {250, 1, 2, 1},
                                                                   {300, 2, 2, 0},
                                                                   {350, 2, 2, 1},
                                                                   {900, 40, 40, 1}});
  folder.write("lens.toml",
               "[lens]\nwidth = 48\nheight = 64\nfx = 50\nfy = 50\ncx = 0\ncy = 63\nk1 = 0.5\n");
  const std::string out = (folder / "part.csv").string();
  const Finished finished =
      convert({start, out, "--refractory-us", "100", "--background-activity-us", "500",
               "--polarity", "on", "--flip-x", "--flip-y", "--rotate", "270"});
  CHECK(finished.exit_code == 0);
  CHECK(contains(finished.output,
                 "6 events read, 1 written; left out: 1 of the other polarity, 1 within the "
                 "refractory period, 3 of background activity"));
  CHECK(read_text(out) == "%geometry:48,64\nt,x,y,p\n350,45,2,1\n");

  // After a quarter turn, (1, 2) is at (2, 62), where this lens moves nothing by half a pixel.
  CHECK(convert({start, out, "--seconds", "0.0001", "--start", "0.0001", "--rotate", "270",
                 "--undistort", (folder / "lens.toml").string()})
            .exit_code == 0);
  CHECK(read_text(out) == "%geometry:48,64\nt,x,y,p\n200,2,62,1\n250,2,62,1\n");

  CHECK(convert({start, out, "--rotate", "45"}).exit_code == 2);
  CHECK(convert({start, out, "--polarity", "up"}).exit_code == 2);
  CHECK(convert({start, out, "--refractory-us", "-1"}).exit_code == 2);
  const Finished prefix = convert({start, out, "--prefix", "left"});
  CHECK(prefix.exit_code == 2);
  CHECK(contains(prefix.errors, "--prefix: it must be up to 16 of A-Z, 0-9 and _, got \"left\""));
  CHECK(contains(convert({start, out, "--crop", "60,0,5,5"}).errors,
                 "--crop must lie within the sensor of 64 x 48 px, got [60, 0, 5, 5]"));
  CHECK(contains(convert({start, out, "--undistort", (folder / "lens.toml").string()}).errors,
                 "lens.toml is of a picture of 48 x 64 px"));
}

TEST_CASE("a conversion that fails leaves no file, and an older one stays") {
  const TemporaryFolder folder;
  // Two days between two events.
  const std::string start =
      write_recording(folder / "start.csv", {{0, 1, 1, 1}, {172'800'000'000, 1, 1, 1}});
  folder.write("old.raw", "as it was");
  const Finished finished = convert({start, (folder / "old.raw").string()});
  CHECK(finished.exit_code == 1);
  CHECK(contains(finished.errors, "EVT3 holds pauses"));
  CHECK(read_text(folder / "old.raw") == "as it was");
  CHECK_FALSE(has_part_left(folder));

  const Finished none = convert({start, (folder / "new.raw").string(), "--start", "200000"});
  CHECK(none.exit_code == 1);
  CHECK(contains(none.errors, "no event is left of 2 in 172800.000 s"));
  CHECK_FALSE(fs::exists(folder / "new.raw"));
  CHECK_FALSE(has_part_left(folder));

  CHECK(convert({start, (folder / "new.xyz").string()}).exit_code == 1);
  CHECK(convert({(folder / "none.raw").string(), (folder / "new.raw").string()}).exit_code == 1);
  CHECK(convert({start, (folder / "new.raw").string(), "--to", "evt9"}).exit_code == 2);
  CHECK_FALSE(fs::exists(folder / "new.raw"));
}

TEST_CASE("an interrupted conversion leaves no file") {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe.raw";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  // More than the reader takes at once.
  const auto writer = make_event_writer(folder / "start.raw", "evt2", kSensor);
  for (std::int64_t i = 0; i < 4; ++i) {
    EventPacket packet = packet_of(many_events());
    packet.start = packet.start + i * 1'000'000;
    writer->write(packet);
  }
  writer->close();
  const std::string start = read_text(folder / "start.raw");
  REQUIRE(start.size() > 600'000);
  ChildProcess program(
      {program_path("puck-convert"), pipe.string(), (folder / "out.csv").string()});
  // The pipe stays open, so the program waits for more.
  std::ofstream feed(pipe, std::ios::binary);
  feed << start << std::flush;
  wait_until([&] { return has_part_left(folder); });
  CHECK(has_part_left(folder));
  program.send(SIGTERM);
  CHECK(program.wait() == -1);
  CHECK_FALSE(has_part_left(folder));
  CHECK_FALSE(fs::exists(folder / "out.csv"));
}

TEST_CASE("a conversion of a part ends with it, also where the pipe does not") {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe.raw";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const std::string start = read_text(write_recording(folder / "start.raw", many_events()));
  ChildProcess program({program_path("puck-convert"), pipe.string(), (folder / "out.csv").string(),
                        "--seconds", "0.01"});
  std::ofstream feed(pipe, std::ios::binary);
  feed << start << std::flush;
  const auto exit_code = program.wait_for(std::chrono::seconds(30));
  REQUIRE(exit_code.has_value());
  CHECK(*exit_code == 0);
  CHECK(events_in(folder / "out.csv").back().t_us < 30'000);
}

TEST_CASE("a writer that fails ends a conversion, also where the pipe does not") {
  if (!fs::exists("/dev/full")) return;
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe.raw";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const std::string start = read_text(write_recording(folder / "start.raw", many_events()));
  ChildProcess program({program_path("puck-convert"), pipe.string(), "/dev/full", "--to", "csv"},
                       {.errors = folder / "errors"});
  std::ofstream feed(pipe, std::ios::binary);
  feed << start << std::flush;
  const auto exit_code = program.wait_for(std::chrono::seconds(30));
  REQUIRE(exit_code.has_value());
  CHECK(*exit_code == 1);
  CHECK(contains(read_text(folder / "errors"), "/dev/full: cannot be written: No space left"));
}

TEST_CASE("a signal ends a conversion that waits for a pipe") {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe.raw";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  for (const bool has_writer : {false, true}) {
    CAPTURE(has_writer);
    ChildProcess program(
        {program_path("puck-convert"), pipe.string(), (folder / "out.csv").string()});
    std::ofstream feed;
    if (has_writer) feed.open(pipe, std::ios::binary);
    program.send(SIGINT);
    const auto exit_code = program.wait_for(std::chrono::seconds(30));
    REQUIRE(exit_code.has_value());
    CHECK(*exit_code == -1);
  }
}

TEST_CASE("of two texts joined the first is converted, with exit 1 and the line of the second") {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 400; ++i) text += std::to_string(1000 + 10'001 * i) + " 1 2 1\n";
  const auto convert_text = [&](const std::string& content) {
    return convert({folder.write("in.txt", content).string(), (folder / "out.raw").string(),
                    "--width", "64", "--height", "48"});
  };
  const Finished joined = convert_text(text + text);
  CHECK(joined.exit_code == 1);
  CHECK(contains(joined.output, "800 events read, 401 written"));
  CHECK(contains(joined.errors, "the times go back at line 401 by 3.9904 s"));
  CHECK(contains(joined.errors, "49.9 % of its events were left out"));
  CHECK(events_in(folder / "out.raw").size() == 401);

  // With the columns' names before each, both are read.
  const std::string named = "t x y p\n" + text;
  CHECK(convert_text(named + named).exit_code == 0);
  CHECK(events_in(folder / "out.raw").size() == 800);
}

TEST_CASE("a copy of a log has no name, so that a signal leaves nothing of it") {
  const TemporaryFolder folder;
  const TemporaryFolder copies;
  const fs::path pipe = folder / "pipe.lcm";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  REQUIRE(convert({write_recording(folder / "start.raw", many_events()),
                   (folder / "start.lcm").string()})
              .exit_code == 0);
  // To stdout a log is written by way of a copy, too.
  ChildProcess program({"env", "TMPDIR=" + copies.path().string(), program_path("puck-convert"),
                        pipe.string(), "-", "--to", "lcm"},
                       {.output = folder / "out"});
  std::ofstream feed(pipe, std::ios::binary);
  feed << read_text(folder / "start.lcm") << std::flush;
  const auto is_copying = [&] {
    const fs::path descriptors = "/proc/" + std::to_string(program.pid()) + "/fd";
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(descriptors, error)) {
      if (contains(fs::read_symlink(entry, error).string(), copies.path().string())) return true;
    }
    return false;
  };
  wait_until(is_copying);
  CHECK(is_copying());
  program.send(SIGKILL);
  CHECK(program.wait() == -1);
  CHECK(fs::is_empty(copies.path()));
}

TEST_CASE("a file can be converted onto itself") {
  const TemporaryFolder folder;
  const auto events = many_events();
  const std::string start = write_recording(folder / "start.raw", events);
  CHECK(convert({start, start, "--to", "evt2"}).exit_code == 0);
  CHECK(events_in(start) == events);
}

}  // namespace
}  // namespace puck
