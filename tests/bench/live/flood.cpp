#include <algorithm>

#include "common/messages/host_time.h"
#include "tests/bench/live/live_measurements.h"
#include "tests/support/crowd_publisher.h"

namespace puck {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::size_t kPacketEvents = 15'000;

/// A few events every millisecond, as from a camera.
void publish_calmly(CrowdPublisher& publisher, milliseconds time, LiveListener& bus) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end) {
    publisher.publish(200);
    bus.listen(milliseconds(1));
  }
}

}  // namespace

void measure_flood(const LiveSetup& setup, seconds time, LiveFigures& figures) {
  LiveSystem system(setup);
  const pid_t tracker = system.pid("puck-tracker");
  LiveListener& bus = system.listener();
  CrowdPublisher publisher(system.url(), setup.key_file);
  publish_calmly(publisher, seconds(1), bus);

  FloodRun run;
  const std::int64_t sent_before = publisher.events();
  const std::int64_t began_utime = host_utime();
  const std::int64_t time_us = std::chrono::microseconds(time).count();
  bus.forget_estimates();
  while (host_utime() < began_utime + time_us) {
    for (int i = 0; i < 100; ++i) publisher.publish(kPacketEvents);
    bus.listen(milliseconds(0));
    if (run.first_mb == 0 && host_utime() > began_utime + time_us / 5) {
      run.first_mb = resident_mb(tracker);
    }
  }
  const std::int64_t ended_utime = host_utime();
  run.last_mb = resident_mb(tracker);
  const double span_us = static_cast<double>(ended_utime - began_utime);
  run.sent_mev_s = static_cast<double>(publisher.events() - sent_before) / span_us;
  publish_calmly(publisher, seconds(2), bus);

  const EstimateTally& estimates = bus.estimates();
  run.oldest_ms = static_cast<double>(estimates.oldest_us) * 1e-3;
  run.recovery_ms =
      std::max(0.0, static_cast<double>(estimates.last_old_utime - ended_utime) * 1e-3);
  run.skipped = bus.counter("puck-tracker", "events_skipped");
  run.lost = bus.counter("puck-tracker", "events_lost");
  run.taken_mev_s =
      static_cast<double>(publisher.events() - sent_before - run.skipped - run.lost) / span_us;
  figures.flood = run;
}

}  // namespace puck
