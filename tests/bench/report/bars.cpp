#include "tests/bench/report/bars.h"

#include <cstdio>

namespace puck {
namespace {

constexpr auto kReport = Bar::Kind::kReport;
constexpr auto kAtLeast = Bar::Kind::kAtLeast;
constexpr auto kAtMost = Bar::Kind::kAtMost;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%g", value);
  return text;
}

const std::vector<Bar> kBars{
    {"eros_k3_ratio", "surface, k = 3, scene, to OpenCV", kAtLeast, 20, 33},
    {"eros_k5_ratio", "surface, k = 5, scene, to OpenCV", kAtLeast, 15, 20},
    {"eros_k7_ratio", "surface, k = 7, scene, to OpenCV", kAtLeast, 15, 21},
    {"eros_k3_mev_s", "surface, k = 3, scene", kReport, 0, std::nullopt},
    {"eros_roi_mev_s", "surface of a region, at most 10 % inside", kAtLeast, 1000, 1300},
    {"eros_roi_ratio", "surface of a region, to OpenCV", kReport, 0, std::nullopt},
    {"writer_slowdown_percent", "event thread, with a 5 kHz reader", kAtMost, 10, std::nullopt},
    {"step_far_ratio", "tracking step, kernel 19x11, to OpenCV", kAtLeast, 25, std::nullopt},
    {"step_mid_ratio", "tracking step, kernel 41x31, to OpenCV", kAtLeast, 30, std::nullopt},
    {"step_near_ratio", "tracking step, kernel 65x53, to OpenCV", kAtLeast, 35, std::nullopt},
    {"step_far_us", "tracking step, kernel 19x11", kReport, 0, std::nullopt},
    {"step_mid_us", "tracking step, kernel 41x31", kReport, 0, std::nullopt},
    {"step_near_us", "tracking step, kernel 65x53", kReport, 0, std::nullopt},
    {"evt3_decode_mev_s", "EVT3 decoding", kAtLeast, 200, std::nullopt},
    {"packet_decode_mev_s", "decoding of packets", kAtLeast, 500, std::nullopt},
    {"lcm_lossless_mev_s", "camera to estimate through LCM", kAtLeast, 10, 40},
    {"busy_lossless_mev_s", "the same, the game at its own speed", kAtLeast, 20, std::nullopt},
    {"busy_tracker_cpu_percent", "the tracker at 10 Mev/s of it, of one core", kAtMost, 60,
     std::nullopt},
    {"lcm_lost", "events lost on that way", kAtMost, 0, std::nullopt},
    {"key_cost_percent", "a key, to the processor time of all", kAtMost, 15, std::nullopt},
    {"key_cost_frame_percent", "the same, a packet a frame", kAtMost, 15, std::nullopt},
    {"estimate_rate_hz", "estimates, at the default limit", kAtLeast, 4900, std::nullopt},
    {"packet_to_estimate_p50_us", "packet to estimate, median", kAtMost, 50, std::nullopt},
    {"packet_to_estimate_p99_us", "packet to estimate, 99 %", kAtMost, 500, std::nullopt},
    {"still_scene_cpu_percent", "a still scene, of one core", kAtMost, 5, std::nullopt},
    {"load_default_10000kev_core_percent", "surface and tracking, 10 Mev/s, one thread", kAtMost,
     60, std::nullopt},
    {"load_default_10000kev_ratio", "the same, to OpenCV's surface alone", kReport, 0,
     std::nullopt},
    {"load_lamp_5kev_core_percent", "a flickering lamp, no puck, one thread", kAtMost, 10,
     std::nullopt},
    {"load_lamp_5kev_tracked_percent", "and of its time, tracked", kAtMost, 0, std::nullopt},
};

}  // namespace

bool Bar::is_met_by(double value) const {
  if (kind == Kind::kAtLeast) return value >= limit;
  if (kind == Kind::kAtMost) return value <= limit;
  return true;
}

std::string Bar::text() const {
  if (kind == Kind::kReport) return "";
  std::string text = (kind == Kind::kAtLeast ? ">= " : "<= ") + number(limit);
  if (reach) text += " (" + number(*reach) + " seen)";
  return text;
}

const std::vector<Bar>& bars() { return kBars; }

}  // namespace puck
