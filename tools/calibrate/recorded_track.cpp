#include "tools/calibrate/recorded_track.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>

#include "common/io/csv_file.h"
#include "common/io/number_limits.h"
#include "common/messaging/channels.h"
#include "common/messaging/log_file.h"
#include "common/messaging/message_codec.h"
#include "puck/head_state_t.hpp"
#include "puck/puck_estimate_t.hpp"
#include "puck/puck_trajectory_t.hpp"

namespace puck {
namespace {

// With a smaller visible share, the centre of the puck may be off.
constexpr double kLeastVisible = 0.9;
// The bridge's limit for a camera without [camera].
constexpr double kMostTurnedDeg = 0.5;
constexpr double kOffTableM = 0.05;

void add(std::vector<TrackPoint>& track, Timestamp t, const TablePoint& at,
         const TableCalibration& table) {
  if (!table.geometry.contains(at, kOffTableM)) return;
  if (track.empty() || t != track.back().t) track.push_back({t, at});
}

void add(std::vector<TrackPoint>& track, Timestamp t, const Pixel& at,
         const TableCalibration& table) {
  const std::optional<TablePoint> place = table.table_from_image.to_table(at);
  if (place) add(track, t, *place, table);
}

std::vector<TrackPoint> read_csv_track(const std::filesystem::path& path,
                                       const TableCalibration& table) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  constexpr double kTracked = puck_trajectory_t::VALIDITY_TRACKED;
  const std::array<CsvColumn, 8> columns{{{"t_us", "sensor_us", std::nullopt, 0, kLatestUs},
                                          {"x_m", {}, kNone},
                                          {"y_m", {}, kNone},
                                          {"x", {}, kNone},
                                          {"y", {}, kNone},
                                          {"visible", {}, 1.0, 0, 1},
                                          {"in_play", {}, 1.0, 0, 1},
                                          {"validity", {}, kTracked, 0, kTracked}}};
  std::vector<TrackPoint> track;
  for (const CsvRow& row : read_csv(path, columns)) {
    const auto& v = row.values;
    const bool is_of_table = v[1] != kNone && v[2] != kNone;
    if (!is_of_table && (v[3] == kNone || v[4] == kNone)) {
      throw_csv_error(path, 1, "the header must name x_m and y_m, on the table, or x and y, px");
    }
    // An occlusion in the image does not affect the true position on the table.
    if (v[6] == 0 || v[7] != kTracked || (!is_of_table && v[5] < kLeastVisible)) continue;
    const Timestamp t{std::llround(v[0])};
    if (is_of_table) {
      add(track, t, TablePoint{v[1], v[2]}, table);
    } else {
      add(track, t, Pixel{v[3], v[4]}, table);
    }
  }
  return track;
}

bool is_seen(const puck_estimate_t& estimate) {
  const auto has = [&](std::int32_t flag) { return (estimate.flags & flag) != 0; };
  return estimate.state == puck_estimate_t::STATE_TRACKING && has(puck_estimate_t::FLAG_POSITION) &&
         !has(puck_estimate_t::FLAG_RESTING) && !has(puck_estimate_t::FLAG_COASTING);
}

void check_head(const head_state_t& head) {
  const double turned_deg = std::hypot(head.yaw_deg, head.pitch_deg);
  if (turned_deg <= kMostTurnedDeg) return;
  throw std::invalid_argument(
      "the camera's head turns in this log, so image positions do not give table positions; "
      "use the bridge's trajectory instead: puck-log export LOG --channel PUCK_TRAJECTORY > "
      "track.csv");
}

std::vector<TrackPoint> read_log_track(const std::filesystem::path& path,
                                       const TableCalibration& table) {
  LogReader reader(path);
  LogRecord record;
  std::vector<TrackPoint> track;
  while (reader.next(record)) {
    const auto channel = find_channel(record.channel, "");
    if (channel == Channel::kHead) {
      head_state_t head;
      if (!decode(record.bytes, head)) check_head(head);
    }
    if (channel != Channel::kEstimate) continue;
    puck_estimate_t estimate;
    if (decode(record.bytes, estimate) || !is_seen(estimate)) continue;
    add(track, Timestamp{estimate.sensor_us}, Pixel{estimate.x_px, estimate.y_px}, table);
  }
  if (track.empty()) throw std::invalid_argument("the log has no ESTIMATE of a puck on the table");
  return track;
}

}  // namespace

std::vector<TrackPoint> read_recorded_track(const std::filesystem::path& path,
                                            const TableCalibration& table) {
  return path.extension() == ".csv" ? read_csv_track(path, table) : read_log_track(path, table);
}

}  // namespace puck
