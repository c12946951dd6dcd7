// A game is recorded and replayed: by LCM's own player and by ours into a fresh tracker, and
// offline.
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"
#include "tests/system/system_bench.h"

namespace puck {
namespace {

using Json = nlohmann::json;

/// A logger and a tracker on a bus of their own.
class RecordedTracker {
 public:
  explicit RecordedTracker(const std::filesystem::path& log,
                           const std::vector<std::string>& settings = {})
      : logger_(start_service("puck-logger", url_, {"logger.path=" + log.string()})),
        tracker_(start_service("puck-tracker", url_, settings)) {
    REQUIRE(bus_.hears({"puck-logger", "puck-tracker"}));
  }

  const std::string& url() const { return url_; }

  /// Until the tracker has reached this sensor time.
  void listen_until(std::int64_t sensor_us) {
    CHECK(bus_.until([&] { return bus_.newest_event_us() >= sensor_us; }, std::chrono::minutes(1)));
  }
  void listen_until_end_of(ChildProcess& source) {
    REQUIRE(bus_.until([&] { return !source.is_running(); }, std::chrono::minutes(1)));
    REQUIRE(source.wait() == 0);
  }
  /// Closes the log.
  void stop() {
    for (ChildProcess* service : {&tracker_, &logger_}) {
      service->send(SIGTERM);
      REQUIRE(service->wait_for(std::chrono::seconds(10)) == 0);
    }
  }

 private:
  std::string url_ = new_lcm_url();
  BusListener bus_{url_};
  ChildProcess logger_;
  ChildProcess tracker_;
};

// Slower than real time, so that a busy machine loses nothing.
const std::vector<std::string> kGame{"simulation.world.autonomous_robot=true", "camera.speed=0.5"};

void record_game(const std::filesystem::path& log, const std::vector<std::string>& settings = {}) {
  RecordedTracker tracker(log, settings);
  ChildProcess camera = start_service("puck-camera", tracker.url(), kGame);
  tracker.listen_until(2'000'000);
  camera.send(SIGTERM);
  REQUIRE(camera.wait_for(std::chrono::seconds(10)) == 0);
  tracker.stop();
}

double mean_difference_px(const TemporaryFolder& folder, const std::string& replay) {
  const Finished report = run_program({program("puck-demo-report"), folder / "game.lcm", "--replay",
                                       folder / replay, "--json", folder / "report.json"});
  INFO(report.errors);
  REQUIRE(report.exit_code == 0);
  const Json json = Json::parse(read_text(folder / "report.json"));
  CHECK(json["replay_estimates"] > 100);
  REQUIRE(json["replay_mean_difference_px"].is_number());
  return json["replay_mean_difference_px"];
}

Finished replay_offline(const std::filesystem::path& log, std::vector<std::string> options) {
  options.insert(options.begin(), {program("puck-evaluate"), log, "--replay"});
  return run_program(options, {.folder = source_folder()});
}

TEST_CASE("a recorded game gives the same track again, live by either player and offline") {
  const TemporaryFolder folder;
  record_game(folder / "game.lcm");

  {
    RecordedTracker tracker(folder / "stock.lcm");
    ChildProcess player({"lcm-logplayer", "--lcm-url=" + tracker.url(), "--regexp=^PUCK_EVENTS$",
                         folder / "game.lcm"},
                        {.output = folder / "player.txt"});
    tracker.listen_until_end_of(player);
    tracker.stop();
  }
  const double stock_px = mean_difference_px(folder, "stock.lcm");
  CHECK(stock_px < 0.5);

  {
    RecordedTracker tracker(folder / "ours.lcm");
    ChildProcess player = start_service(
        "puck-camera", tracker.url(),
        {"camera.source=log", "camera.file=" + (folder / "game.lcm").string(), "camera.speed=0.5"});
    tracker.listen_until_end_of(player);
    tracker.stop();
  }
  const double ours_px = mean_difference_px(folder, "ours.lcm");
  CHECK(ours_px < 0.5);

  for (const char* csv : {"a.csv", "b.csv"}) {
    const Finished offline = replay_offline(
        folder / "game.lcm", {"--csv", folder / csv, "--json", folder / "offline.json"});
    INFO(offline.errors);
    CHECK(offline.exit_code == 0);
  }
  CHECK(read_text(folder / "a.csv") == read_text(folder / "b.csv"));
  const Json json = Json::parse(read_text(folder / "offline.json"));
  CHECK(json["replay_estimates"] > 100);
  const double offline_px = json["replay_mean_difference_px"];
  CHECK(offline_px < 0.5);
  MESSAGE("mean difference, px: lcm-logplayer " << stock_px << ", puck-camera " << ours_px
                                                << ", offline " << offline_px);
}

TEST_CASE("a reproducible tracker's estimates are recomputed offline, to the bit") {
  const TemporaryFolder folder;
  const auto log = folder / "game.lcm";
  record_game(log, {"tracker.reproducible=true"});
  const Finished same = replay_offline(log, {"--exact", "--json", folder / "same.json"});
  INFO(same.errors);
  CHECK(same.exit_code == 0);
  const Json json = Json::parse(read_text(folder / "same.json"));
  CHECK(json["replay_estimates"] > 100);
  CHECK(json["replay_equal"] == json["replay_estimates"]);
  CHECK(json["replay_max_difference_px"] == 0);
  MESSAGE("equal to the bit: " << json["replay_equal"] << " of " << json["replay_estimates"]);

  // Another tracker gives other estimates.
  const Finished other = replay_offline(log, {"--exact", "--preset", "correlation"});
  CHECK(other.exit_code == 1);
  CHECK(other.errors.find("estimates are not equal to the bit") != std::string::npos);
  const Finished bounded =
      replay_offline(log, {"--preset", "correlation", "--max-difference-px", "0.000001"});
  CHECK(bounded.exit_code == 1);
  CHECK(bounded.errors.find("differs by more than 1e-06 px") != std::string::npos);
}

TEST_CASE("a replay is refused without a log, or with a tracker that the service does not run") {
  const TemporaryFolder folder;
  const Finished no_log = replay_offline(folder.write("a.txt", "1 2 3 1\n"), {});
  CHECK(no_log.exit_code == 1);
  CHECK(no_log.errors.find("--replay needs a log of LCM") != std::string::npos);
  CHECK(replay_offline(folder / "a.txt", {"--rate", "100"}).exit_code == 2);
  CHECK(replay_offline(folder / "a.txt", {"--drop-packets", "1"}).exit_code == 2);
}

}  // namespace
}  // namespace puck
