#include "tests/bench/live/live_figures.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace puck {
namespace {

using Json = nlohmann::ordered_json;

// Share of the requested rate below which a run does not count.
constexpr double kPace = 0.98;

void print_cpu(const CpuLoad& cpu) {
  for (const auto& [service, percent] : cpu) std::printf("  %s %.0f %%", service.c_str(), percent);
  std::printf("\n");
}

void print(const TransportRun& run) {
  std::printf("  %4.0f Mev/s: %5.1f sent, %lld lost of %lld", run.wanted_mev_s, run.sent_mev_s,
              static_cast<long long>(run.lost()), static_cast<long long>(run.events_sent));
  std::printf(" (%lld on the way, the tracker counted %lld; %lld skipped)",
              static_cast<long long>(run.lost_on_the_way),
              static_cast<long long>(run.counted_by_tracker), static_cast<long long>(run.skipped));
  std::printf(", camera %.1f ms late\n        ", static_cast<double>(run.late_us) * 1e-3);
  print_cpu(run.cpu);
  if (!run.kept_pace()) {
    std::printf("          the camera MISSED the pace: %.2f of %.0f Mev/s\n", run.sent_mev_s,
                run.wanted_mev_s);
  }
}

void print_highest(const std::vector<TransportRun>& runs) {
  std::printf("  highest rate with nothing lost: %.3g Mev/s\n", highest_lossless_mev_s(runs));
}

void print(const char* what, const std::optional<LatencySummary>& latency) {
  if (!latency) return;
  std::printf("  %-20s p50 %6lld, p99 %6lld, most %6lld us (%lld)\n", what,
              static_cast<long long>(latency->p50_us), static_cast<long long>(latency->p99_us),
              static_cast<long long>(latency->max_us), static_cast<long long>(latency->samples));
}

void print(const KeyCost& cost) {
  std::printf("Key, at %.0f Mev/s in packets of %d bytes: %.1f %% of a core without",
              cost.rate_mev_s, cost.packet_bytes, cost.plain.cpu_percent);
  std::printf(", %.1f %% with, all services: %.1f %% more; %lld and %lld events lost\n",
              cost.sealed.cpu_percent, cost.percent(), static_cast<long long>(cost.plain.lost),
              static_cast<long long>(cost.sealed.lost));
}

void print_network(const LiveFigures& f) {
  if (f.network_transport.empty()) return;
  std::printf("Camera to tracker over a cable, a packet a frame\n");
  for (const TransportRun& run : f.network_transport) print(run);
  print_highest(f.network_transport);
  print("packet to estimate", f.network_packet_to_estimate);
}

void print(const FloodRun& run) {
  std::printf("Flood: %.1f Mev/s sent, %.1f taken; %lld events skipped, %lld lost\n",
              run.sent_mev_s, run.taken_mev_s, static_cast<long long>(run.skipped),
              static_cast<long long>(run.lost));
  std::printf("  the tracker's memory %.0f MB, at the end %.0f MB\n", run.first_mb, run.last_mb);
  std::printf("  estimates were up to %.0f ms old; at the newest again after %.0f ms\n",
              run.oldest_ms, run.recovery_ms);
}

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

void add(Json& json, const std::string& name, const std::optional<LatencySummary>& latency) {
  json[name + "_p50_us"] = latency ? Json(latency->p50_us) : Json(nullptr);
  json[name + "_p99_us"] = latency ? Json(latency->p99_us) : Json(nullptr);
}

Json to_json(const LiveFigures& f) {
  Json json;
  const bool has_transport = !f.transport.empty();
  json["lcm_lossless_mev_s"] =
      has_transport ? Json(highest_lossless_mev_s(f.transport)) : Json(nullptr);
  json["lcm_lost"] = has_transport ? Json(f.transport.front().lost()) : Json(nullptr);
  json["lcm_sent_mev_s"] = has_transport ? Json(f.transport.front().sent_mev_s) : Json(nullptr);
  const bool has_busy = !f.busy.empty();
  json["busy_lossless_mev_s"] = has_busy ? Json(highest_lossless_mev_s(f.busy)) : Json(nullptr);
  json["busy_tracker_cpu_percent"] =
      has_busy ? Json(f.busy.front().cpu.at("puck-tracker")) : Json(nullptr);
  const bool has_network = !f.network_transport.empty();
  json["network_lossless_mev_s"] =
      has_network ? Json(highest_lossless_mev_s(f.network_transport)) : Json(nullptr);
  json["network_lost"] = has_network ? Json(f.network_transport.front().lost()) : Json(nullptr);
  json["network_sent_mev_s"] =
      has_network ? Json(f.network_transport.front().sent_mev_s) : Json(nullptr);
  add(json, "network_packet_to_estimate", f.network_packet_to_estimate);
  json["key_cost_percent"] = f.key.empty() ? Json(nullptr) : Json(f.key.front().percent());
  json["key_cost_frame_percent"] = f.key.empty() ? Json(nullptr) : Json(f.key.back().percent());
  json["estimate_rate_hz"] = or_null(f.estimate_rate_hz);
  json["estimate_rate_unlimited_hz"] = or_null(f.estimate_rate_unlimited_hz);
  add(json, "machine_wake", f.machine_wake);
  add(json, "packet_to_estimate", f.packet_to_estimate);
  add(json, "sensor_to_estimate", f.sensor_to_estimate);
  add(json, "backlog", f.backlog);
  json["still_scene_cpu_percent"] = or_null(f.still_scene_cpu_percent);
  add(json, "wake", f.wake);
  json["flood_recovery_ms"] = f.flood ? Json(f.flood->recovery_ms) : Json(nullptr);
  json["flood_growth_mb"] = f.flood ? Json(f.flood->last_mb - f.flood->first_mb) : Json(nullptr);
  return json;
}

}  // namespace

bool TransportRun::kept_pace() const { return sent_mev_s >= kPace * wanted_mev_s; }

void KeyCost::Side::add(const TransportRun& run) {
  double sum = 0;
  for (const auto& [service, percent] : run.cpu) sum += percent;
  sum *= run.wanted_mev_s / run.sent_mev_s;
  if (cpu_percent == 0 || sum < cpu_percent) cpu_percent = sum;
  lost += run.lost();
}

double highest_lossless_mev_s(const std::vector<TransportRun>& runs) {
  double highest = 0;
  for (const TransportRun& run : runs) {
    if (!run.lost_nothing()) break;
    highest = std::max(highest, run.kept_pace() ? run.wanted_mev_s : run.sent_mev_s);
  }
  return highest;
}

void print(const LiveFigures& f) {
  if (!f.transport.empty()) {
    std::printf("Camera to tracker over LCM, %s in a loop\n", f.recording.c_str());
    for (const TransportRun& run : f.transport) print(run);
    print_highest(f.transport);
  }
  if (!f.busy.empty()) {
    std::printf("The game at its own speed, as a sensor with many events would see it\n");
    for (const TransportRun& run : f.busy) print(run);
    print_highest(f.busy);
  }
  print_network(f);
  for (const KeyCost& cost : f.key) print(cost);
  if (f.packet_to_estimate) {
    std::printf("At 1 Mev/s\n");
    print("machine: a wake-up", f.machine_wake);
    print("packet to estimate", f.packet_to_estimate);
    print("sensor to estimate", f.sensor_to_estimate);
    print("backlog", f.backlog);
    print_cpu(f.cpu_at_1_mev_s);
  }
  if (f.estimate_rate_hz) {
    std::printf("Estimates while events come: %.0f Hz at the default limit of 5000",
                *f.estimate_rate_hz);
    if (f.estimate_rate_unlimited_hz) {
      std::printf(", %.0f Hz without", *f.estimate_rate_unlimited_hz);
    }
    std::printf("\n");
  }
  if (f.still_scene_cpu_percent) {
    std::printf("Still scene, 10 kev/s of noise, puck %s\n",
                f.still_scene_tracked ? "tracked" : "NOT TRACKED");
    std::printf(
        "  tracker and camera: %.1f %% of a core; they wake up %.0f and %.0f times a second\n",
        *f.still_scene_cpu_percent, f.still_scene_tracker_wake_ups_hz,
        f.still_scene_camera_wake_ups_hz);
    print_cpu(f.still_scene_cpu);
    print("event to waking up", f.wake);
  }
  if (f.flood) print(*f.flood);
}

void write_json(const LiveFigures& figures, const std::filesystem::path& path) {
  std::ofstream file(path);
  file << to_json(figures).dump(2) << '\n';
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace puck
