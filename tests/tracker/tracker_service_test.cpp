#include "services/tracker/tracker_service.h"

#include <cmath>
#include <mutex>
#include <span>
#include <sstream>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <lcm/lcm.h>
#include <spdlog/sinks/null_sink.h>
#include <spdlog/sinks/ostream_sink.h>

#include "common/io/pixel_mask_file.h"
#include "common/messages/host_time.h"
#include "common/messaging/event_packing.h"
#include "tests/support/service_bench.h"
#include "tests/support/skewed_machine.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_url.h"
#include "tests/tracker/running_tracker.h"

namespace puck {
namespace {

using std::chrono::milliseconds;
using namespace test;

}  // namespace

TEST_CASE("the service receives events and publishes estimates, with the chain of times") {
  RunningTracker tracker;
  Pixel truth;
  for (int i = 1; i <= 200; ++i) {
    truth = {40 + 0.3 * i, 50 + 0.1 * i};
    tracker.publish(puck_at(truth, i * 1000), 1'000'000);
    std::this_thread::sleep_for(milliseconds(1));
    // A tracker with a backlog would skip packets.
    if (i % 5 == 0) {
      REQUIRE(tracker.eventually([&](const auto& e) { return e.sensor_us == i * 1000; }));
    }
  }
  REQUIRE(tracker.eventually([](const auto& e) { return e.sensor_us == 200'000; }));
  const puck_estimate_t last = tracker.estimates().back();
  CHECK(last.state == puck_estimate_t::STATE_TRACKING);
  CHECK(std::abs(last.x_px - truth.x) < 2);
  CHECK(std::abs(last.y_px - truth.y) < 2);
  CHECK(last.events_session == tracker.bus().session());
  CHECK(last.event_utime == 1'000'000 + 200'000);
  CHECK(last.packet_received_utime > 0);
  CHECK(last.tracking_started_utime >= last.packet_received_utime);
  CHECK(last.utime >= last.tracking_started_utime);
  CHECK(last.packets_lost == 0);
  CHECK(last.image_width == kSensor.width);
  tracker.stop();
  CHECK(counter(tracker.service(), "events_lost") == 0);
  CHECK(counter(tracker.service(), "events_thinned") == 0);
  CHECK(counter(tracker.service(), "estimates") ==
        static_cast<std::int64_t>(tracker.bus().counters<puck_estimate_t>().published));
}

TEST_CASE("a tracker without events reports no puck") {
  RunningTracker tracker;
  std::this_thread::sleep_for(milliseconds(50));
  CHECK(tracker.estimates().empty());
}

TEST_CASE("an out-of-order packet and one of another sensor are dropped") {
  RunningTracker tracker;
  tracker.publish(puck_at({80, 60}, 10'000));
  tracker.publish(puck_at({80, 60}, 5'000));
  EventPacker other({.sensor = {320, 240}, .packet_bytes = 60000});
  other.pack({20'000}, puck_at({80, 60}, 0).events,
             [&](event_packet_t& packet) { tracker.publish_raw(packet); });
  tracker.publish(puck_at({80, 60}, 30'000));
  REQUIRE(tracker.eventually([](const auto& e) { return e.sensor_us == 30'000; }));
  tracker.stop();
  CHECK(counter(tracker.service(), "packets_late") == 2);
  CHECK(counter(tracker.service(), "events_received") == 2 * 150);
}

TEST_CASE("masked events are dropped and counted, but not by another sensor's mask") {
  const TemporaryFolder folder;
  const auto settings = [&](SensorSize sensor) {
    const std::vector<PixelPlace> pixels{{1, 1}, {2, 1}};
    write_pixel_mask_file(folder / "mask.toml", PixelMask(sensor, pixels), "");
    return "hot_pixel_mask = \"" + (folder / "mask.toml").string() + "\"\n";
  };
  const auto masked_of = [&](SensorSize sensor) {
    RunningTracker tracker(settings(sensor));
    EventPacket events = puck_at({80, 60}, 10'000);
    for (Event& event : std::span(events.events).first(20)) {
      event.x = 1;
      event.y = 1;
    }
    tracker.publish(events);
    REQUIRE(tracker.eventually([](const auto& e) { return e.sensor_us == 10'000; }));
    tracker.stop();
    return counter(tracker.service(), "events_masked");
  };
  CHECK(masked_of(kSensor) == 20);
  CHECK(masked_of({640, 480}) == 0);
}

TEST_CASE("a sensor's restarted clock begins a new track without delay") {
  RunningTracker tracker;
  tracker.publish(puck_at({80, 60}, 10'000'000));
  REQUIRE(tracker.eventually([](const auto& e) { return e.sensor_us == 10'000'000; }));
  std::int64_t t_us = 3'000;
  CHECK(ServiceBench::until([&] { return tracker.estimates().back().sensor_us < 10'000'000; },
                            [&] {
                              tracker.publish(puck_at({80, 60}, t_us += 1000));
                            }));
  tracker.publish(puck_at({80, 60}, t_us += 1000));
  CHECK(tracker.eventually([&](const auto& e) { return e.sensor_us == t_us; }));
}

TEST_CASE("a detection region beyond a small sensor is ignored") {
  RunningTracker tracker("detection_region = [1000, 600, 100, 100]\n");
  tracker.publish(puck_at({80, 60}, 10'000));
  REQUIRE(
      tracker.eventually([](const auto& e) { return e.state == puck_estimate_t::STATE_TRACKING; }));
  CHECK(std::abs(tracker.estimates().back().x_px - 80) < 2);
}

TEST_CASE("a log that is played twice is tracked twice") {
  const std::string url = private_lcm_url();
  ServiceBench bench(url);
  std::mutex mutex;
  puck_estimate_t newest{};
  bench.bus.subscribe<puck_estimate_t>([&](const puck_estimate_t& estimate, const Receipt&) {
    const std::lock_guard lock(mutex);
    newest = estimate;
  });
  Config config;
  TrackerServiceParams params = TrackerService::read_params(config);
  params.size_model = {25, 0, 0, 17, 0, 0};
  bench.make<TrackerService>(params);
  REQUIRE(bench.start());

  // Like a log player: the same bytes, with the first session and numbers.
  const std::unique_ptr<lcm_t, void (*)(lcm_t*)> player(lcm_create(url.c_str()), &lcm_destroy);
  REQUIRE(player);
  EventPacker packer({.sensor = kSensor, .packet_bytes = 60000});
  std::vector<std::vector<std::uint8_t>> log;
  for (const std::int64_t t_us : {10'000, 20'000}) {
    packer.pack({t_us}, puck_at({80, 60}, t_us).events, [&](event_packet_t& packet) {
      packet.utime = 1;
      packet.session = 77;
      packet.seq = static_cast<std::int64_t>(log.size());
      encode(packet, log.emplace_back());
    });
  }
  REQUIRE(log.size() == 2);
  const auto play = [&](std::size_t i) {
    lcm_publish(player.get(), "PUCK_EVENTS", log[i].data(), static_cast<unsigned>(log[i].size()));
    const std::int64_t t_us = i == 0 ? 10'000 : 20'000;
    return ServiceBench::until(
        [&] {
          const std::lock_guard lock(mutex);
          return newest.sensor_us == t_us;
        },
        [] {});
  };
  CHECK(play(0));
  CHECK(play(1));
  std::this_thread::sleep_for(milliseconds(600));
  CHECK(play(0));
  CHECK(play(1));
  bench.stop();
}

TEST_CASE("a camera with an impossible start time of its sensor is tracked without it") {
  RunningTracker tracker;
  tracker.publish(puck_at({80, 60}, 1000), std::int64_t{1} << 53);
  CHECK(tracker.eventually(
      [](const puck_estimate_t& e) { return e.sensor_us == 1000 && e.event_utime == 0; }));
  CHECK(tracker.bus().counters<puck_estimate_t>().publish_failures == 0);
}

TEST_CASE("a second publisher of events is counted and named, by its address without a STATUS") {
  const std::string url = private_lcm_url();
  ServiceBench bench(url);
  std::ostringstream log;
  bench.log.sinks() = {std::make_shared<spdlog::sinks::ostream_sink_mt>(log)};
  Config config;
  bench.make<TrackerService>(TrackerService::read_params(config));
  std::mutex mutex;
  service_status_t status{};
  bench.bus.subscribe<service_status_t>([&](const service_status_t& newest, const Receipt&) {
    const std::lock_guard lock(mutex);
    if (newest.session == bench.bus.session()) status = newest;
  });
  SkewedMachine first(url, 4711, 0);
  SkewedMachine second(url, 4712, 0);
  REQUIRE(bench.start());
  const auto packets_of = [](SkewedMachine& camera, std::int64_t t_us) {
    EventPacker packer({.sensor = kSensor, .packet_bytes = 60000});
    const EventPacket events = puck_at({80, 60}, t_us);
    packer.pack(events.start, events.events,
                [&](event_packet_t& packet) { camera.publish(packet); });
  };
  for (int i = 0; i < 100; ++i) {
    packets_of(first, 1000 * i);
    // At once: after 0.5 s of silence, as in a delayed test, a publisher is no longer followed.
    if (i > 50) packets_of(second, 1000 * i);
    std::this_thread::sleep_for(milliseconds(1));
  }
  // A tracker that ends leaves the newest messages unread.
  const auto all_came = [&] {
    const std::lock_guard lock(mutex);
    return counter(status, "packets_received") == 100 && counter(status, "packets_of_others") == 49;
  };
  CHECK(ServiceBench::until(all_came, [] {}));
  bench.stop();
  const auto& tracker = static_cast<const TrackerService&>(*bench.service);
  CHECK(counter(tracker, "packets_of_others") > 40);
  CHECK(counter(tracker, "packets_received") == 100);
  CAPTURE(log.str());
  CHECK(log.str().find("following events of session 4711,") != std::string::npos);
  CHECK(log.str().find("ignores a second publisher of events: session 4712, at ") !=
        std::string::npos);
}

TEST_CASE("with the camera's clock hours away times and latency are by the tracker's clock") {
  constexpr std::int64_t kHourUs = 3'600'000'000;
  const std::string url = private_lcm_url();
  ServiceBench bench(url);
  std::mutex mutex;
  puck_estimate_t newest{};
  bench.bus.subscribe<puck_estimate_t>([&](const puck_estimate_t& estimate, const Receipt&) {
    const std::lock_guard lock(mutex);
    newest = estimate;
  });
  Config config;
  TrackerServiceParams params = TrackerService::read_params(config);
  params.size_model = {25, 0, 0, 17, 0, 0};
  bench.make<TrackerService>(params);
  REQUIRE(bench.start());

  SkewedMachine machine(url, 4711, -5 * kHourUs);
  EventPacker packer({.sensor = kSensor, .packet_bytes = 60000});
  const std::int64_t began_us = host_monotonic_us();
  const std::int64_t zero_utime = machine.utime();
  const auto send = [&](std::int64_t age_us, bool recorded = false) {
    machine.serve();
    const std::int64_t t_us = host_monotonic_us() - began_us;
    packer.pack({t_us}, puck_at({80, 60}, t_us).events, [&](event_packet_t& packet) {
      packet.sensor_zero_utime = zero_utime;
      packet.recorded = recorded ? 1 : 0;
      machine.publish(packet, age_us);
    });
  };
  const auto is_live = [&] {
    const std::lock_guard lock(mutex);
    return (newest.flags & puck_estimate_t::FLAG_LIVE) != 0;
  };
  machine.answer(false);
  REQUIRE(ServiceBench::until(
      [&] {
        const std::lock_guard lock(mutex);
        return newest.sensor_us > 100'000;
      },
      [&] { send(0); }));
  CHECK_FALSE(is_live());
  machine.answer(true);
  REQUIRE(ServiceBench::until(is_live, [&] { send(0); }));
  {
    const std::lock_guard lock(mutex);
    CHECK(newest.event_utime > newest.utime - 10'000'000);
    CHECK(newest.event_utime < newest.utime + 10'000'000);
  }
  // The same camera is not live while it plays a recording, however punctual.
  CHECK(ServiceBench::until([&] { return !is_live(); }, [&] { send(0, true); }));
  REQUIRE(ServiceBench::until(is_live, [&] { send(0); }));
  // Nor from a log.
  CHECK(ServiceBench::until([&] { return !is_live(); }, [&] { send(500'000); }));
  bench.stop();
  StatusReport report;
  bench.service->report(report);
  for (const StatusLatency& latency : report.latencies) {
    if (latency.name != "sensor_to_estimate") continue;
    CHECK(latency.samples > 0);
    CHECK(latency.max_us < 10'000'000);
  }
}

TEST_CASE("a resting puck is reported only while its camera is heard") {
  RunningTracker tracker;
  const auto is_resting = [](const puck_estimate_t& e) {
    return (e.flags & puck_estimate_t::FLAG_RESTING) != 0;
  };
  std::int64_t t_us = 0;
  REQUIRE(ServiceBench::until(
      [&] {
        const auto estimates = tracker.estimates();
        return !estimates.empty() && is_resting(estimates.back());
      },
      [&] {
        tracker.publish(puck_at({80, 60}, t_us += 5'000));
        std::this_thread::sleep_for(milliseconds(3));
      }));
  REQUIRE(tracker.eventually([&](const auto& e) { return !is_resting(e); }));
  CHECK(tracker.estimates().back().state == puck_estimate_t::STATE_TRACKING);
}

TEST_CASE("an estimate without a packet has no waiting time") {
  const TemporaryFolder folder;
  const std::vector<PixelPlace> masked{{1, 1}};
  write_pixel_mask_file(folder / "mask.toml", PixelMask(kSensor, masked), "");
  const std::int64_t began_us = host_monotonic_us();
  RunningTracker tracker("hot_pixel_mask = \"" + (folder / "mask.toml").string() + "\"\n");
  // A packet without a remaining event begins a track; its first estimate has no packet.
  const auto begin_track = [&](std::int64_t t_us) {
    tracker.publish({{t_us}, {{1, 1, 1, 0}}});
    REQUIRE(tracker.eventually([](const auto& e) { return e.events_applied == 0; }));
  };
  const auto follow = [&](std::int64_t t_us) {
    tracker.publish(puck_at({80, 60}, t_us));
    REQUIRE(tracker.eventually([&](const auto& e) { return e.sensor_us == t_us; }));
  };
  begin_track(10'000'000);
  follow(10'001'000);
  follow(10'002'000);
  // Longer than the tracker's test for a restarted clock.
  std::this_thread::sleep_for(milliseconds(1'100));
  begin_track(1'000);
  follow(2'000);
  tracker.stop();

  StatusReport report;
  tracker.service().report(report);
  const std::int64_t ran_us = host_monotonic_us() - began_us;
  for (const StatusLatency& latency : report.latencies) {
    CAPTURE(latency.name);
    CHECK(latency.max_us <= ran_us);
    if (latency.name != "sensor_to_estimate") CHECK(latency.samples == 3);
  }
}

TEST_CASE("estimates continue after the last event") {
  RunningTracker tracker;
  tracker.publish(puck_at({80, 60}, 10'000));
  REQUIRE(tracker.eventually([](const auto& e) { return e.sensor_us == 10'000; }));
  const auto before = tracker.estimates().back().seq;
  CHECK(tracker.eventually([&](const auto& e) { return e.seq >= before + 5; }));
}

}  // namespace puck
