// The whole game, as a person plays it: tools/demo.sh, tools/play.sh.
#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"
#include "tests/system/system_bench.h"

namespace puck {
namespace {

using std::chrono::seconds;

// With a temporary folder of its own, to check for leftovers.
std::vector<std::string> demo_command(const TemporaryFolder& folder,
                                      const std::vector<std::string>& options) {
  std::filesystem::create_directory(folder / "tmp");
  std::vector<std::string> command{"env", "TMPDIR=" + (folder / "tmp").string(), "tools/demo.sh"};
  command.insert(command.end(), options.begin(), options.end());
  return command;
}

void check_nothing_is_left(const ChildProcess& demo, const TemporaryFolder& folder) {
  CHECK_FALSE(demo.group_is_left());
  CHECK(std::filesystem::is_empty(folder / "tmp"));
}

}  // namespace

TEST_CASE("the demo plays a game, loses nothing, replays it and leaves nothing behind") {
  const TemporaryFolder folder;
  const auto json_file = folder / "demo.json";
  ChildProcess demo(
      demo_command(folder, {"--seconds", "8", "--json", json_file.string()}),
      {.folder = source_folder(), .output = folder / "output", .errors = folder / "errors"});
  const auto exit_code = demo.wait_for(seconds(240));
  INFO(read_text(folder / "output"));
  INFO(read_text(folder / "errors"));
  REQUIRE(exit_code == 0);
  check_nothing_is_left(demo, folder);

  const auto json = nlohmann::json::parse(read_text(json_file));
  for (const char* key : {"events_sent",
                          "events_received",
                          "events_lost",
                          "estimates",
                          "estimate_rate_hz",
                          "mean_px",
                          "p95_px",
                          "lost_percent",
                          "messages_received",
                          "packet_to_estimate_p50_us",
                          "packet_to_estimate_p99_us",
                          "sensor_to_estimate_p50_us",
                          "sensor_to_estimate_p99_us",
                          "backlog_p50_us",
                          "backlog_p99_us",
                          "shots",
                          "saves",
                          "goals_against",
                          "replay_estimates",
                          "replay_mean_difference_px"}) {
    CAPTURE(key);
    REQUIRE(json.contains(key));
    CHECK(json[key].is_number());
  }
  CHECK(json["events_sent"] > 100'000);
  CHECK(json["events_received"] == json["events_sent"]);
  CHECK(json["events_lost"] == 0);
  CHECK(json["estimates"] > 0);
  CHECK(json["mean_px"] < 5.0);
  CHECK(json["replay_estimates"] > 0);
  CHECK(json["replay_mean_difference_px"] < 2.0);
}

TEST_CASE("Ctrl-C in the middle of a game ends the demo, and leaves nothing behind") {
  const TemporaryFolder folder;
  ChildProcess demo(
      demo_command(folder, {"--seconds", "60"}),
      {.folder = source_folder(), .output = folder / "output", .errors = folder / "errors"});
  const auto is_playing = [&] {
    return read_text(folder / "output").find("playing for 60 s") != std::string::npos;
  };
  REQUIRE(wait_until(is_playing, seconds(120)));
  demo.send_to_group(SIGINT);
  CHECK(demo.wait_for(seconds(20)) == 130);
  check_nothing_is_left(demo, folder);
}

TEST_CASE("the demo refuses unknown options") {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--fast"}, {"--seconds"}, {"--seconds", "long"}}) {
    std::vector<std::string> command{"tools/demo.sh"};
    command.insert(command.end(), options.begin(), options.end());
    CHECK(run_program(command, {.folder = source_folder()}).exit_code == 2);
  }
}

TEST_CASE("tools/play.sh --real-time plays through the services, on events") {
  const TemporaryFolder folder;
  const auto json_file = folder / "play.json";
  ChildProcess play(
      {"tools/play.sh", "--real-time", "--source", "events", "--seconds", "6", "--max-speed", "6",
       "--json", json_file.string()},
      {.folder = source_folder(), .output = folder / "output", .errors = folder / "errors"});
  const auto exit_code = play.wait_for(seconds(240));
  INFO(read_text(folder / "output"));
  INFO(read_text(folder / "errors"));
  REQUIRE(exit_code == 0);
  CHECK_FALSE(play.group_is_left());
  const auto json = nlohmann::json::parse(read_text(json_file));
  CHECK(json["played_s"] > 1);
  // Not more: a saved puck can still go in, which is a goal without another shot.
  CHECK(json["shots"].get<int>() >= json["saves"].get<int>());
}

TEST_CASE("tools/play.sh refuses options incompatible with --real-time at once") {
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--shots", "5"},
                                                  {"--source", "truth"},
                                                  {"--max-speed", "99"},
                                                  {"--max-speed", "0.5"},
                                                  {"--max-speed", "nan"},
                                                  {"--seconds", "long"},
                                                  {"--seconds"}}) {
    CAPTURE(options.front());
    std::vector<std::string> command{"tools/play.sh", "--real-time"};
    command.insert(command.end(), options.begin(), options.end());
    const Finished refused = run_program(command, {.folder = source_folder()});
    CHECK(refused.exit_code == 2);
    CHECK(refused.output.find("building") == std::string::npos);
  }
}

}  // namespace puck
