// The real puck-info.
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "common/io/event_writer.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/child_process.h"
#include "tests/support/contains.h"
#include "tests/support/environment.h"

namespace puck {
namespace {

using Json = nlohmann::json;

constexpr SensorSize kInfoSensor{64, 48};

Finished info(std::vector<std::string> arguments, const ChildOptions& options = {}) {
  arguments.insert(arguments.begin(), program_path("puck-info"));
  return run_program(arguments, options);
}

Json json_of(const Finished& finished) { return Json::parse(finished.output); }

// 3 s of 1000 events a second from 1 s on, every fourth brighter, in steps of 1 ms; the pixel (5,
// 5) has a tenth of them; a pause of 0.5 s.
std::vector<PlainEvent> known_events() {
  std::vector<PlainEvent> events;
  for (int i = 0; i < 3000; ++i) {
    const bool is_hot = i % 10 == 0;
    const int pause_us = i < 1500 ? 0 : 500'000;
    events.push_back({1'000'000 + 1000 * i + pause_us, is_hot ? 5 : i * 31 % 64,
                      is_hot ? 5 : i * 17 % 48, i % 4 == 0 ? 1 : 0});
  }
  return events;
}

std::string write_known(const TemporaryFolder& folder, const std::string& name) {
  const auto writer = make_event_writer(folder / name, "", kInfoSensor);
  writer->write(packet_of(known_events()));
  writer->close();
  return (folder / name).string();
}

TEST_CASE("puck-info --json has the figures of a known recording") {
  const TemporaryFolder folder;
  const Finished finished = info({write_known(folder, "known.aedat4"), "--json"});
  CHECK(finished.exit_code == 0);
  const Json json = json_of(finished);
  CHECK(json["encoding"] == "AEDAT4, LZ4");
  CHECK(json["width"] == 64);
  CHECK(json["height"] == 48);
  CHECK(json["events"] == 3000);
  CHECK(json["first_us"] == 1'000'000);
  CHECK(json["last_us"] == 4'499'000);
  CHECK(json["on_percent"] == 25.0);
  CHECK(json["time_step_us"] == 1000);
  CHECK(json["gaps_of_10_ms"] == 1);
  CHECK(json["longest_gaps"][0] == Json{{"from_us", 2'499'000}, {"length_us", 501'000}});
  REQUIRE(json["hot_pixels"].size() == 1);
  CHECK(json["hot_pixels"][0]["x"] == 5);
  CHECK(json["problems"].empty());
  std::int64_t counted = 0;
  for (const Json& bin : json["rates"]["events"]) counted += bin.get<std::int64_t>();
  CHECK(counted == 3000);
}

TEST_CASE("puck-info tells the same in words, of a file and of stdin") {
  const TemporaryFolder folder;
  const std::string file = write_known(folder, "known.raw");
  const Finished finished = info({file});
  CHECK(finished.exit_code == 0);
  for (const char* part :
       {"64 x 48 px", "3000 in 3.499000 s, 857.39 ev/s", "in steps of 1000 µs", "25.0 % brighter",
        "1, with 10.", "(5, 5) 86 Hz", "1 of 10 ms or more; the longest: 0.501 s at 2.499 s",
        "nothing is wrong with it"}) {
    CHECK_MESSAGE(contains(finished.output, part), part);
  }
  const Finished piped = info({"-"}, {.input = file});
  CHECK(piped.exit_code == 0);
  CHECK(contains(piped.output, "3000 in 3.499000 s"));
}

TEST_CASE("puck-info exits with 1 when something is wrong with the file") {
  const TemporaryFolder folder;
  const std::string bytes = read_text(write_known(folder, "known.raw"));
  const auto problems_of = [&](const std::string& content) {
    const Finished finished = info({folder.write("wrong.raw", content).string(), "--json"});
    CHECK(finished.exit_code == 1);
    return json_of(finished)["problems"].dump();
  };
  CHECK(contains(problems_of(bytes.substr(0, bytes.size() - 1)), "the file is cut off"));
  // A word of type 1, which EVT3 has not.
  CHECK(contains(problems_of(bytes + std::string("\0\x10", 2)), "malformed"));
  // A column of 640.
  CHECK(contains(problems_of(bytes + "\x80\x22"), "outside the sensor"));
  CHECK(contains(problems_of(bytes.substr(0, bytes.find("% end\n") + 6)), "there are no events"));

  // Two texts joined.
  std::string text;
  for (int i = 0; i < 400; ++i) text += std::to_string(1000 + 10'001 * i) + " 1 2 1\n";
  const Finished joined =
      info({folder.write("joined.txt", text + text).string(), "--width", "64", "--height", "48"});
  CHECK(joined.exit_code == 1);
  CHECK(contains(joined.output, "the times go back at line 401 by 3.9904 s"));
  CHECK(contains(joined.output, "49.9 % of its events were left out"));

  CHECK(info({(folder / "none.raw").string()}).exit_code == 1);
  CHECK(info({}).exit_code == 2);
  for (const char* prefix : {"left", "A-B", "ABCDEFGHIJKLMNOPQ"}) {
    CHECK(info({write_known(folder, "known.raw"), "--prefix", prefix}).exit_code == 2);
  }
}

TEST_CASE("puck-info --plots draws two charts") {
  const TemporaryFolder folder;
  const std::string charts = (folder / "charts").string();
  const Finished finished = info({write_known(folder, "known.raw"), "--plots", charts});
  CHECK(finished.exit_code == 0);
  for (const char* name : {"charts/rate.png", "charts/pixels.png"}) {
    CHECK(read_text(folder / name).starts_with("\x89PNG"));
  }
}

}  // namespace
}  // namespace puck
