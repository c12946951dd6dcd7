#include "tools/view/recording/logged_game.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/messaging/log_file.h"
#include "tests/support/contains.h"
#include "tests/support/event_log_writer.h"
#include "tests/support/temporary_folder.h"
#include "tools/view/recording/recording_run.h"

namespace puck {
namespace {

constexpr SensorSize kLoggedSensor{64, 48};

template <typename Message>
std::vector<std::uint8_t> bytes_of(Message message) {
  std::vector<std::uint8_t> bytes;
  encode(message, bytes);
  return bytes;
}

puck_estimate_t estimate_at(std::int64_t sensor_us, double x_px, std::int64_t tracker = 7) {
  puck_estimate_t estimate{};
  estimate.session = tracker;
  estimate.events_session = 3;
  estimate.sensor_us = sensor_us;
  estimate.state = puck_estimate_t::STATE_TRACKING;
  estimate.flags = puck_estimate_t::FLAG_POSITION;
  estimate.x_px = x_px;
  estimate.width_px = estimate.height_px = 10;
  estimate.image_width = kLoggedSensor.width;
  estimate.image_height = kLoggedSensor.height;
  return estimate;
}

// Events of 0.1 s, and what the services said about them.
class GameLogFile {
 public:
  explicit GameLogFile(bool has_events = true) {
    EventLogWriter log(path(), kLoggedSensor);
    log.begin_session(3, 1'000'000);
    if (has_events) log.write(numbered_events(0, 1000, 100));
    log.write_bytes("PUCK_ESTIMATE", 1'000'001, bytes_of(estimate_at(10'000, 11)));
    log.write_bytes("PUCK_ESTIMATE", 1'000'002, bytes_of(estimate_at(15'000, 99, 8)));
    puck_trajectory_t trajectory{};
    trajectory.session = 9;
    trajectory.estimate_session = 7;
    trajectory.sensor_us = 20'000;
    trajectory.validity = puck_trajectory_t::VALIDITY_TRACKED;
    trajectory.x_m = 1.5;
    trajectory.path_t_s = {0, 0.1};
    trajectory.path_x_m = {1.5, 1.4};
    trajectory.path_y_m = {0, 0};
    log.write_bytes("PUCK_TRAJECTORY", 1'000'003, bytes_of(trajectory));
    log.write_bytes("PUCK_TRAJECTORY", 1'000'003, {1, 2, 3});
    game_state_t game{};
    game.session = 9;
    game.phase = game_state_t::PHASE_RALLY;
    game.goals_for = 2;
    log.write_bytes("PUCK_GAME", 1'000'004, bytes_of(game));
    log.write_bytes("PUCK_ESTIMATE", 1'000'005, bytes_of(estimate_at(50'000, 22)));
    log.flush();
  }
  std::filesystem::path path() const { return folder_ / "game.lcm"; }

 private:
  TemporaryFolder folder_;
};

TEST_CASE("a log's own estimates and game appear at their sensor times") {
  const GameLogFile file;
  LoggedGame game(file.path(), "");
  game.advance_to({9'000});
  CHECK(!game.estimate());
  CHECK(!game.table());
  game.advance_to({19'000});
  REQUIRE(game.estimate());
  CHECK(game.estimate()->position->x == 11);
  CHECK(!game.table());
  game.advance_to({20'000});
  REQUIRE(game.table());
  CHECK(game.table()->puck.state.position.x_m == 1.5);
  CHECK(game.table()->path.size() == 2);
  CHECK(game.table()->goals_for == 2);
  CHECK(game.table()->phase == "rally");
  game.advance_to({60'000});
  CHECK(game.estimate()->position->x == 22);
  game.rewind();
  CHECK(!game.estimate());
}

TEST_CASE("a log is shown with what its tracker said, without a size model") {
  const GameLogFile file;
  RecordingOptions options;
  options.recording = file.path();
  const OpenedRecording recording(options);
  CHECK(recording.trackers().front() == kLoggedTracker);
  RecordingRun run(recording);
  run.choose(0, kLoggedTracker);
  run.start(recording.first());
  while (run.now().us < 30'000 && run.step({30'000}) == RecordingRun::Progress::kAdvanced) continue;
  ViewScene scene;
  run.fill({}, scene);
  REQUIRE(scene.tracks[0].estimate);
  CHECK(scene.tracks[0].estimate->position->x == 11);
  PictureWishes table;
  table.view = PictureWishes::View::kTable;
  run.fill(table, scene);
  REQUIRE(scene.table);
  CHECK(scene.table->puck.state.position.x_m == 1.5);
}

TEST_CASE("a log without events says so, and shows what its services said to its end") {
  const GameLogFile file(false);
  RecordingOptions options;
  options.recording = file.path();
  const OpenedRecording recording(options);
  CHECK(!recording.has_events());
  CHECK(recording.last() == Timestamp{50'000});
  CHECK(recording.sensor() == kLoggedSensor);
  CHECK(recording.trackers() == std::vector<std::string>{kLoggedTracker});
  REQUIRE(!recording.messages().empty());
  CHECK(contains(recording.messages()[0].text, "without events"));
  RecordingRun run(recording);
  run.choose(0, kLoggedTracker);
  run.start(recording.first());
  while (run.step({200'000}) != RecordingRun::Progress::kEnded) continue;
  CHECK(run.now() >= Timestamp{50'000});
  CHECK(run.now() < Timestamp{60'000});
  ViewScene scene;
  run.fill({}, scene);
  REQUIRE(scene.tracks[0].estimate);
  CHECK(scene.tracks[0].estimate->position->x == 22);
}

}  // namespace
}  // namespace puck
