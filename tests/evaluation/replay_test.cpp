// puck-evaluate --replay: recomputes the estimates of a log.
#include "tools/evaluate/replay.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/messaging/conversions.h"
#include "common/recording/event_log_reader.h"
#include "common/vision/surface_tracker.h"
#include "tests/support/event_log_writer.h"
#include "tests/support/temporary_folder.h"
#include "tests/vision/puck_picture.h"

namespace puck {
namespace {

constexpr SensorSize kLogSensor{160, 120};

TrackerSetup ring_setup() {
  TrackerSetup setup;
  // These rings do not move, and `default` detects a puck by its motion.
  setup.preset = Preset::kCorrelation;
  setup.size_model = {25, 0, 0, 17, 0, 0};
  return setup;
}

EventPacket packet_number(int i) {
  return {{1000 * i}, test::contour_events(kLogSensor, {40 + 0.3 * i, 60}, {25, 17}, 100 + i % 7)};
}

/// Contents of a log: a tracker that receives the packets from `heard_from` on and answers every
/// third, with optional faults.
struct FaultyLog {
  int packets = 150;
  int heard_from = 1;
  int lost_to_tracker = 0;   // This packet; 0: none.
  int missing_in_log = 0;    // This packet; 0: none.
  int estimate_missing = 0;  // The answer to this packet; 0: none.
  int estimate_bent = 0;     // The answer to this packet, by one bit; 0: none.
};

void record(const std::filesystem::path& path, const FaultyLog& recording) {
  EventLogWriter log(path, kLogSensor);
  SurfaceTracker tracker(kLogSensor, ring_setup().pipeline_params(), ring_setup().size_model);
  std::int64_t seq = 0;
  std::vector<std::uint8_t> bytes;
  for (int i = 1; i <= recording.packets; ++i) {
    const EventPacket packet = packet_number(i);
    if (i == recording.missing_in_log) {
      log.lose(packet);
    } else {
      log.write(packet);
    }
    if (i < recording.heard_from || i == recording.lost_to_tracker) continue;
    tracker.update(packet);
    if (i % 3 != 0) continue;
    puck_estimate_t message = to_message({{}, tracker.estimate(), kLogSensor});
    message.utime = log.last().utime + 1;
    message.session = 77;
    message.events_session = log.last().session;
    if (i > recording.lost_to_tracker && recording.lost_to_tracker != 0) message.packets_lost = 1;
    if (i == recording.estimate_missing) {
      ++seq;
      continue;
    }
    if (i == recording.estimate_bent) {
      message.x_px = std::nextafter(message.x_px, 1e9);
    }
    // A heartbeat repeats the estimate.
    for (int repeat = 0; repeat < 2; ++repeat) {
      message.seq = seq++;
      encode(message, bytes);
      log.write_bytes("PUCK_ESTIMATE", message.utime, bytes);
    }
  }
}

ReplayComparison replay(const FaultyLog& recording) {
  const TemporaryFolder folder;
  record(folder / "a.lcm", recording);
  const auto events = open_event_log(folder / "a.lcm", "", EventLog::Sessions::kFirst);
  return run_replay(*events, folder / "a.lcm", "", ring_setup(), [](const EvaluatedTick&) {})
      .comparison;
}

bool notes(const ReplayComparison& comparison, const std::string& part) {
  return std::any_of(comparison.notes.begin(), comparison.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

TEST_CASE("a whole recorded run is reproduced to the bit") {
  const ReplayComparison result = replay({});
  CHECK(result.estimates == 50);
  CHECK(result.repeated == 50);
  CHECK(result.equal == 50);
  CHECK(result.state_differs == 0);
  REQUIRE(result.mean_difference_px.has_value());
  CHECK(*result.mean_difference_px == 0);
  CHECK(*result.max_difference_px == 0);
  CHECK(result.notes.empty());
}

TEST_CASE("a late tracker's run is reproduced from its first packet") {
  const ReplayComparison result = replay({.heard_from = 38});
  CHECK(result.estimates == 38);
  CHECK(result.equal == 38);
  CHECK(result.notes.empty());
}

TEST_CASE("an estimate that differs in its last bit is not equal") {
  const ReplayComparison result = replay({.estimate_bent = 120});
  CHECK(result.equal == 49);
  CHECK(*result.max_difference_px > 0);
  CHECK(*result.max_difference_px < 1e-9);
}

TEST_CASE("a packet lost by the tracker or the log is reported, and the estimates stay close") {
  const ReplayComparison lost = replay({.lost_to_tracker = 91});
  CHECK(lost.estimates == 50);
  CHECK(lost.equal < 50);
  CHECK(lost.equal >= 30);
  CHECK(*lost.mean_difference_px < 0.5);
  CHECK(notes(lost, "1 packets were lost on the way to the recorded tracker"));
  CHECK(notes(lost, "1 estimates rest on other events than the log holds"));

  const ReplayComparison missing = replay({.missing_in_log = 91});
  CHECK(missing.estimates == 50);
  CHECK(missing.equal >= 30);
  CHECK(*missing.mean_difference_px < 0.5);
  CHECK(notes(missing, "1 estimates rest on other events than the log holds"));
}

TEST_CASE("an estimate missing from the log is reported") {
  CHECK(notes(replay({.estimate_missing = 60}), "1 estimates are missing in the log"));
}

TEST_CASE("a log without estimates is refused") {
  const TemporaryFolder folder;
  record(folder / "a.lcm", {.packets = 2});
  const auto events = open_event_log(folder / "a.lcm", "", EventLog::Sessions::kFirst);
  CHECK_THROWS_WITH(
      run_replay(*events, folder / "a.lcm", "", ring_setup(), [](const EvaluatedTick&) {}),
      doctest::Contains("a log without estimates that rest on its events"));
}

}  // namespace
}  // namespace puck
