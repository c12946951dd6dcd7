#include "tests/bench/live/live_measurements.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>

#include "tests/bench/live/machine_wake.h"

namespace puck {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// Until the tracker has found the puck, and caches and clocks are warm.
constexpr seconds kWarmUp{2};
constexpr milliseconds kNextStatus{300};
constexpr int kOftenUs = 150;

std::optional<LatencySummary> latency_of(const LiveListener& bus, const std::string& name) {
  const service_status_t* status = bus.status("puck-tracker");
  if (status == nullptr) return std::nullopt;
  const auto at = std::find(status->latency_name.begin(), status->latency_name.end(), name);
  if (at == status->latency_name.end()) return std::nullopt;
  const auto i = static_cast<std::size_t>(at - status->latency_name.begin());
  return LatencySummary{status->latency_p50_us[i], status->latency_p99_us[i],
                        status->latency_max_us[i], status->latency_samples[i]};
}

std::string write_key(const std::filesystem::path& folder) {
  const auto path = folder / "key";
  std::ofstream(path) << std::string(32, 'k');
  std::filesystem::permissions(path, std::filesystem::perms::owner_read);
  return path.string();
}

}  // namespace

TransportRun measure_transport(const LiveSetup& setup, const Recording& recording,
                               double rate_mev_s, seconds time, int packet_bytes) {
  LiveSystem system(setup);
  std::vector<std::string> camera = looped_at(recording, rate_mev_s);
  camera.push_back("camera.packet_bytes=" + std::to_string(packet_bytes));
  system.start_camera(camera);
  TransportRun run{.wanted_mev_s = rate_mev_s};
  LiveListener& before = system.listener();
  before.listen(kNextStatus);
  const std::int64_t sent_before = before.counter("puck-camera", "events_sent");
  const std::int64_t utime_before = before.status("puck-camera")->utime;
  run.cpu = system.watch(time);
  system.stop_camera();

  const LiveListener& bus = system.listener();
  run.events_sent = bus.counter("puck-camera", "events_sent");
  run.late_us = bus.counter("puck-camera", "late_us");
  run.sent_mev_s = static_cast<double>(run.events_sent - sent_before) /
                   static_cast<double>(bus.status("puck-camera")->utime - utime_before);
  run.lost_on_the_way = run.events_sent - bus.counter("puck-tracker", "events_received");
  run.counted_by_tracker = bus.counter("puck-tracker", "events_lost");
  run.skipped = bus.counter("puck-tracker", "events_skipped");
  run.thinned = bus.counter("puck-tracker", "events_thinned");
  return run;
}

void measure_network(LiveSetup setup, const Recording& dense, const Recording& game,
                     const std::vector<double>& rates_mev_s, seconds sustained, seconds brief,
                     LiveFigures& figures) {
  const TwoMachines machines;
  setup.machines = &machines;
  for (const double rate : rates_mev_s) {
    const auto time = rate == rates_mev_s.front() ? sustained : brief;
    figures.network_transport.push_back(measure_transport(setup, dense, rate, time));
    if (!figures.network_transport.back().carried_all()) break;
  }
  LiveSystem system(setup);
  system.start_camera(looped_at(game, 1));
  system.watch(2 * brief);
  LiveListener& bus = system.listener();
  bus.listen(kNextStatus);
  figures.network_packet_to_estimate = latency_of(bus, "packet_to_estimate");
}

KeyCost measure_key(LiveSetup setup, const Recording& recording, double rate_mev_s,
                    int packet_bytes, seconds time, int turns) {
  const TemporaryFolder folder;
  const std::string key = write_key(folder.path());
  KeyCost cost{.rate_mev_s = rate_mev_s, .packet_bytes = packet_bytes};
  for (int turn = 0; turn < turns; ++turn) {
    for (KeyCost::Side* side : {&cost.plain, &cost.sealed}) {
      setup.key_file = side == &cost.sealed ? key : "";
      side->add(measure_transport(setup, recording, rate_mev_s, time, packet_bytes));
    }
  }
  return cost;
}

void measure_latency(const LiveSetup& setup, const Recording& game, seconds time,
                     LiveFigures& figures) {
  figures.machine_wake = measure_machine_wake();
  LiveSystem system(setup);
  system.start_camera(looped_at(game, 1));
  figures.cpu_at_1_mev_s = system.watch(time);
  LiveListener& bus = system.listener();
  bus.listen(kNextStatus);
  figures.packet_to_estimate = latency_of(bus, "packet_to_estimate");
  figures.sensor_to_estimate = latency_of(bus, "sensor_to_estimate");
  figures.backlog = latency_of(bus, "backlog");
}

double measure_rate(const LiveSetup& setup, const Recording& game, int max_publish_hz,
                    seconds time) {
  LiveSystem system(setup, {"tracker.max_publish_hz=" + std::to_string(max_publish_hz)});
  // Between two packets there is nothing new to say.
  std::vector<std::string> camera = looped_at(game, 1);
  camera.push_back("camera.flush_us=" + std::to_string(kOftenUs));
  system.start_camera(camera);
  LiveListener& bus = system.listener();
  bus.listen(kWarmUp);
  bus.forget_estimates();
  bus.listen(time);
  return bus.estimates().rate_hz();
}

void measure_still_scene(const LiveSetup& setup, const Recording& scene, seconds time,
                         LiveFigures& figures) {
  LiveSystem system(setup);
  system.start_camera(
      {"camera.source=file", "camera.file=" + scene.file.string(), "camera.at_end=wait"});
  system.watch(milliseconds(static_cast<int>(kStillSceneRests_s * 1000)) + kWarmUp);
  figures.still_scene_cpu = system.watch(time);
  figures.still_scene_cpu_percent =
      figures.still_scene_cpu.at("puck-camera") + figures.still_scene_cpu.at("puck-tracker");
  figures.still_scene_camera_wake_ups_hz = system.wake_ups_hz("puck-camera");
  figures.still_scene_tracker_wake_ups_hz = system.wake_ups_hz("puck-tracker");
  LiveListener& bus = system.listener();
  bus.forget_estimates();
  bus.listen(kNextStatus);
  figures.wake = latency_of(bus, "packet_to_look");
  const EstimateTally& estimates = bus.estimates();
  figures.still_scene_tracked = estimates.heard > 0 && estimates.tracking == estimates.heard;
}

}  // namespace puck
