// Recordings of real cameras through puck-camera, LCM and puck-tracker.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "common/messaging/log_file.h"
#include "common/messaging/message_codec.h"
#include "tests/support/recordings.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/system_bench.h"

namespace puck {
namespace {

struct Recording {
  std::string file;
  std::int64_t events;
  std::int64_t span_us;
  std::vector<std::string> settings;
  std::int64_t least_estimates;  // with news in each
};

/// A logger's record of a run.
struct LoggedRun {
  std::int64_t events = 0;
  std::int64_t first_us = std::numeric_limits<std::int64_t>::max();
  std::int64_t last_us = 0;
  std::vector<puck_estimate_t> estimates;
};

LoggedRun read_run(const std::filesystem::path& path) {
  LogReader reader(path);
  LoggedRun run;
  LogRecord record;
  while (reader.next(record)) {
    if (record.channel == "PUCK_EVENTS") {
      event_packet_t packet;
      REQUIRE_FALSE(decode(record.bytes, packet).has_value());
      run.events += packet.count;
      run.first_us = std::min(run.first_us, packet.first_event_us);
      run.last_us = std::max(run.last_us, packet.first_event_us + packet.duration_us);
    } else if (record.channel == "PUCK_ESTIMATE") {
      REQUIRE_FALSE(decode(record.bytes, run.estimates.emplace_back()).has_value());
    }
  }
  CHECK_FALSE(reader.damage().has_value());
  return run;
}

void play(const std::filesystem::path& recordings, const Recording& recording) {
  CAPTURE(recording.file);
  const TemporaryFolder folder;
  const std::string url = new_lcm_url();
  BusListener bus(url);
  ChildProcess logger =
      start_service("puck-logger", url, {"logger.path=" + (folder / "a.lcm").string()});
  ChildProcess tracker = start_service("puck-tracker", url);
  REQUIRE(bus.hears({"puck-logger", "puck-tracker"}));

  std::vector<std::string> settings{"camera.source=file",
                                    "camera.file=" + (recordings / recording.file).string()};
  settings.insert(settings.end(), recording.settings.begin(), recording.settings.end());
  ChildProcess camera = start_service("puck-camera", url, settings);
  REQUIRE(bus.until([&] { return !camera.is_running(); }));
  CHECK(camera.wait() == 0);
  CHECK(bus.until([&] { return bus.counter("puck-camera", "events_sent") == recording.events; }));
  CHECK(bus.until([&] {
    return bus.counter("puck-tracker", "events_received") == recording.events &&
           bus.fresh_estimates() >= recording.least_estimates;
  }));
  CHECK(bus.counter("puck-camera", "events_sent") == recording.events);
  CHECK(bus.counter("puck-tracker", "events_received") == recording.events);
  CHECK(bus.counter("puck-tracker", "events_lost") == 0);
  CHECK(bus.counter("puck-tracker", "packets_lost") == 0);
  CHECK(bus.fresh_estimates() >= recording.least_estimates);
  for (ChildProcess* service : {&tracker, &logger}) {
    service->send(SIGTERM);
    CHECK(service->wait_for(std::chrono::seconds(10)) == 0);
  }

  const LoggedRun run = read_run(folder / "a.lcm");
  CHECK(run.events == recording.events);
  CHECK(run.last_us - run.first_us == doctest::Approx(recording.span_us).epsilon(0.01));
  for (const puck_estimate_t& estimate : run.estimates) {
    if (estimate.events_applied == 0) continue;
    REQUIRE(estimate.sensor_us >= run.first_us);
    REQUIRE(estimate.sensor_us <= run.last_us);
  }
  CHECK(run.estimates.back().events_applied == recording.events);
}

TEST_CASE("real recordings reach the tracker whole, and it publishes estimates") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  play(*recordings, {.file = "walking_640x480_evt3.extracted.raw",
                     .events = 343'474,
                     .span_us = 2'078'000,
                     .settings = {"camera.width=640", "camera.height=480"},
                     .least_estimates = 100});
  // Slower than its 5 Mev/s, at which a tracker on a busy machine would skip packets.
  play(*recordings, {.file = "sparklers_gen31_640x480_evt2.raw",
                     .events = 521'252,
                     .span_us = 96'000,
                     .settings = {"camera.speed=0.1"},
                     .least_estimates = 5});
}

}  // namespace
}  // namespace puck
