// From a simulated recording to figures: puck-simulate, puck-calibrate, puck-evaluate.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "common/io/event_reader.h"
#include "common/io/event_writer.h"
#include "tests/support/contains.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/yarp_log_encoder.h"
#include "tests/system/system_bench.h"

namespace puck {
namespace {

using Json = nlohmann::json;

/// A folder with a simulated recording of 2 s, named game.
class ToolBench {
 public:
  ToolBench() { run("puck-simulate", {"--output", "game", "--seconds", "2", "--seed", "3"}); }

  void run(const std::string& name, const std::vector<std::string>& arguments) const {
    run_tool(name, folder, arguments);
  }
  Finished call(const std::string& name, const std::vector<std::string>& arguments) const {
    return call_tool(name, folder, arguments);
  }
  /// With truth, and with the figures written to a file.
  Json evaluate(const std::vector<std::string>& options) const {
    return evaluate_game(folder, options);
  }
  std::string first_line(const std::string& file) const {
    const std::string text = read_text(folder / file);
    return text.substr(0, text.find('\n'));
  }

  TemporaryFolder folder;
};

void check_all_keys(const Json& json) {
  for (const char* key :
       {"algorithm", "preset", "events", "duration_s", "estimates", "mean_px", "median_px",
        "p95_px", "within_2px_percent", "within_3p5px_percent", "within_4px_percent",
        "lost_percent", "said_and_wrong_percent", "longest_loss_ms", "time_to_first_track_ms",
        "latency_p50_us", "latency_p99_us", "throughput_mev_s"}) {
    CAPTURE(key);
    CHECK(json.contains(key));
  }
  for (const char* key : {"cpu_us_per_ms", "mev_s", "p25_px", "p75_px", "max_px", "nees_mean",
                          "nees_within_95_percent", "score_threshold", "score_average_precision"}) {
    CAPTURE(key);
    CHECK(json.contains(key));
  }
}

/// Without figures that depend on the machine.
Json without_cost(Json json) {
  CHECK(json.erase("cpu_us_per_ms") == 1);
  return json;
}

}  // namespace

TEST_CASE("a simulated recording is calibrated and evaluated, and two runs agree to the byte") {
  const ToolBench bench;
  for (const char* file : {"game.raw", "game.truth.csv", "game.annotations.csv", "game.toml"}) {
    CAPTURE(file);
    CHECK(std::filesystem::file_size(bench.folder / file) > 0);
  }
  CHECK(bench.first_line("game.truth.csv").starts_with("t_us,x,y,width,height"));
  CHECK(bench.first_line("game.annotations.csv") == "t_us,x,y,width,height");
  bench.run("puck-calibrate", {"size", "game.annotations.csv", "--output", "size.toml"});

  const std::vector<std::string> options{"--size-model", "size.toml", "--rate", "1000", "--csv"};
  auto first = options;
  first.insert(first.end(), {"first.csv", "--plots", "plots"});
  auto second = options;
  second.emplace_back("second.csv");
  const Json json = bench.evaluate(first);
  CHECK(without_cost(bench.evaluate(second)) == without_cost(json));
  CHECK(bench.first_line("first.csv") == "t_us,x,y,width,height,score,state,latency_us");
  CHECK(read_text(bench.folder / "first.csv").size() > 10'000);
  CHECK(read_text(bench.folder / "first.csv") == read_text(bench.folder / "second.csv"));
  for (const char* chart : {"error.png", "within.png", "score.png"}) {
    CAPTURE(chart);
    CHECK(std::filesystem::file_size(bench.folder / "plots" / chart) > 5'000);
  }

  check_all_keys(json);
  CHECK(json["algorithm"] == "puck");
  CHECK(json["preset"] == "default");
  CHECK(json["duration_s"] == doctest::Approx(2.0).epsilon(0.01));
  CHECK(json["estimates"] > 500);
  CHECK(json["mean_px"] < 3.0);
  CHECK(json["lost_percent"] < 5.0);
  CHECK(json["latency_p50_us"].is_null());
  CHECK(json["throughput_mev_s"].is_null());
}

TEST_CASE("a part of a pipe is evaluated, which is read once") {
  const ToolBench bench;
  const Finished run = run_program({"sh", "-c",
                                    "cat game.raw | " + program_path("puck-evaluate") +
                                        " - --start 0.5 --seconds 1 --truth game.truth.csv "
                                        "--size-model game.toml --json a.json"},
                                   {.folder = bench.folder.path()});
  CHECK(run.exit_code == 0);
  CHECK(Json::parse(read_text(bench.folder / "a.json"))["mean_px"].is_number());
}

TEST_CASE("a missing recording is told before a missing size model") {
  const TemporaryFolder folder;
  const Finished run =
      run_program({program_path("puck-evaluate"), "none.raw", "--size-model", "none.toml"},
                  {.folder = folder.path()});
  CHECK(run.exit_code == 1);
  CHECK(contains(run.errors, "none.raw: cannot be opened: No such file or directory"));
}

TEST_CASE("without matplotlib the figures are written, and one line says how to get the charts") {
  const ToolBench bench;
  bench.folder.write("matplotlib.py", "raise ImportError\n");
  const Finished run = run_program(
      {"env", "PYTHONPATH=" + bench.folder.path().string(), program_path("puck-evaluate"),
       "game.raw", "--truth", "game.truth.csv", "--json", "game.json", "--plots", "plots"},
      {.folder = bench.folder.path()});
  CHECK(run.exit_code == 1);
  CHECK(
      run.errors.starts_with("puck-evaluate: charts need matplotlib: apt-get install "
                             "python3-matplotlib, then run: "));
  CHECK(std::count(run.errors.begin(), run.errors.end(), '\n') == 1);
  CHECK(Json::parse(read_text(bench.folder / "game.json"))["mean_px"].is_number());
  CHECK(std::filesystem::exists(bench.folder / "plots/error.csv"));
}

TEST_CASE("the simulated sensor's measurements are drawn") {
  const TemporaryFolder folder;
  run_tool("puck-simulate", folder, {"--sensor-checks", "sensor"});
  for (const char* chart :
       {"step", "contrast", "frequency", "latency", "noise_rate", "noise_balance",
        "noise_intervals", "thresholds", "refractory", "saturation", "burst", "conservation"}) {
    CAPTURE(chart);
    CHECK(std::filesystem::file_size(folder / "sensor" / (std::string(chart) + ".png")) > 5'000);
  }
}

TEST_CASE("every preset and every algorithm runs, and every mode measures its own figures" *
          doctest::test_suite("deep")) {
  const ToolBench bench;
  for (const char* preset : {"paper", "reference", "correlation", "default"}) {
    CAPTURE(preset);
    const Json json = bench.evaluate({"--preset", preset, "--rate", "200"});
    check_all_keys(json);
    CHECK(json["preset"] == preset);
    CHECK(json["estimates"] > 100);
    CHECK(json["mean_px"].is_number());
  }
  for (const char* algorithm : {"cluster", "particle-filter", "particle-filter-eros"}) {
    CAPTURE(algorithm);
    const Json json = bench.evaluate({"--algorithm", algorithm, "--rate", "200"});
    check_all_keys(json);
    CHECK(json["algorithm"] == algorithm);
    CHECK(json["preset"].is_null());
    CHECK(json["estimates"] > 100);
  }
  const Json real_time = bench.evaluate({"--real-time"});
  check_all_keys(real_time);
  CHECK(real_time["latency_p50_us"].is_number());
  CHECK(real_time["throughput_mev_s"].is_null());
  const Json fast = bench.evaluate({"--as-fast-as-possible"});
  check_all_keys(fast);
  CHECK(fast["throughput_mev_s"] > 0.0);
  CHECK(fast["mean_px"].is_null());
}

TEST_CASE("the same seed gives the same recording, another seed another") {
  const ToolBench bench;
  bench.run("puck-simulate", {"--output", "a", "--seconds", "0.3", "--seed", "5"});
  bench.run("puck-simulate", {"--output", "b", "--seconds", "0.3", "--seed", "5"});
  bench.run("puck-simulate", {"--output", "c", "--seconds", "0.3", "--seed", "6"});
  for (const char* kind : {".raw", ".truth.csv"}) {
    const auto text_of = [&](const std::string& name) {
      return read_text(bench.folder / (name + kind));
    };
    CHECK(text_of("a") == text_of("b"));
    CHECK(text_of("a") != text_of("c"));
  }
}

TEST_CASE("a game in an IIT camera's YARP log is tracked like the same events in a text file") {
  const ToolBench bench;
  const auto game = open_event_file(bench.folder / "game.raw");
  EventPacket packet;
  REQUIRE(game->read(packet, 1));
  const Timestamp zero = packet.start;
  YarpLogEncoder log(YarpEncoding::kStamped, zero);
  {
    const auto text = make_event_writer(bench.folder / "game.txt", "text", game->sensor_size());
    constexpr std::size_t kMostBytes = 50'000;
    game->rewind();
    while (log.text().size() < kMostBytes - 2000 && game->read(packet, 100)) {
      log.add(packet, 1000);
      packet.start = {packet.start - zero};
      text->write(packet);
    }
    text->close();
    CHECK(log.text().size() <= kMostBytes);
  }
  write_text(bench.folder / "data.log", log.text());
  const auto written = open_event_file(bench.folder / "game.txt");
  const auto logged = open_event_file(bench.folder / "data.log", {.sensor = {640, 480}});
  EventPacket logged_packet;
  std::size_t events = 0;
  while (written->read(packet, 1000)) {
    REQUIRE(logged->read(logged_packet, packet.events.size()));
    REQUIRE(logged_packet.start == packet.start);
    REQUIRE(logged_packet.events == packet.events);
    events += packet.events.size();
  }
  CHECK(events > 2000);
  CHECK_FALSE(logged->read(logged_packet, 1));
  const std::string size = source_folder() / "config/calibration/simulated_size.toml";
  for (const std::string name : {"game.txt", "data.log"}) {
    bench.run("puck-evaluate", {name, "--algorithm", "cluster", "--size-model", size, "--csv",
                                name + ".csv", "--width", "640", "--height", "480"});
  }
  const std::string ticks = read_text(bench.folder / "data.log.csv");
  CHECK(std::count(ticks.begin(), ticks.end(), '\n') > 10);
  CHECK(ticks == read_text(bench.folder / "game.txt.csv"));
}

}  // namespace puck
