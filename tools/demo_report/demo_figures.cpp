#include "tools/demo_report/demo_figures.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/evaluation/accuracy_score.h"
#include "common/evaluation/truth_track.h"
#include "common/messaging/conversions.h"
#include "common/messaging/status_reporter.h"

namespace puck {
namespace {

using Json = nlohmann::ordered_json;

// The first of several estimates with the same newest event.
std::vector<puck_estimate_t> with_news(const std::vector<puck_estimate_t>& estimates) {
  std::vector<puck_estimate_t> result;
  for (const puck_estimate_t& estimate : estimates) {
    if (result.empty() || estimate.sensor_us > result.back().sensor_us) result.push_back(estimate);
  }
  return result;
}

void score(const TruthTrack& truth, const std::vector<puck_estimate_t>& estimates,
           DemoFigures& figures) {
  if (estimates.empty()) return;
  const puck_estimate_t& first = estimates.front();
  AccuracyScore score(truth, {first.image_width, first.image_height});
  for (const puck_estimate_t& estimate : estimates) {
    score.add({estimate.sensor_us}, from_message(estimate));
  }
  const AccuracyReport report = score.report();
  if (report.estimates == 0) return;
  figures.mean_px = report.mean_px;
  figures.median_px = report.median_px;
  figures.p95_px = report.p95_px;
  figures.lost_percent = report.lost_percent;
}

bool has_position(const puck_estimate_t& estimate) {
  return (estimate.flags & puck_estimate_t::FLAG_POSITION) != 0;
}

// The recorded position at a sensor time, linear between the estimates on both sides of it.
std::optional<Pixel> recorded_at(const std::vector<puck_estimate_t>& recorded,
                                 std::int64_t sensor_us) {
  const auto after = std::lower_bound(
      recorded.begin(), recorded.end(), sensor_us,
      [](const puck_estimate_t& estimate, std::int64_t time) { return estimate.sensor_us < time; });
  if (after == recorded.end() || !has_position(*after)) return std::nullopt;
  if (after->sensor_us == sensor_us) return Pixel{after->x_px, after->y_px};
  if (after == recorded.begin() || !has_position(*(after - 1))) return std::nullopt;
  const puck_estimate_t& a = *(after - 1);
  const double f = static_cast<double>(sensor_us - a.sensor_us) /
                   static_cast<double>(after->sensor_us - a.sensor_us);
  return Pixel{a.x_px + f * (after->x_px - a.x_px), a.y_px + f * (after->y_px - a.y_px)};
}

// Where the puck was out of sight, there is no position to agree on.
void compare(const std::vector<puck_estimate_t>& recorded, const GameLog& replay,
             const std::optional<TruthTrack>& truth, DemoFigures& figures) {
  const std::vector<puck_estimate_t> replayed = with_news(replay.estimates);
  figures.replay_estimates = static_cast<std::int64_t>(replay.estimates.size());
  double sum = 0;
  std::int64_t compared = 0;
  for (const puck_estimate_t& estimate : replayed) {
    const auto there = recorded_at(recorded, estimate.sensor_us);
    if (!there || !has_position(estimate)) continue;
    const auto row = truth ? truth->at({estimate.sensor_us}) : std::nullopt;
    if (row && !is_visible(*row)) continue;
    sum += std::hypot(estimate.x_px - there->x, estimate.y_px - there->y);
    ++compared;
  }
  if (compared > 0) figures.replay_mean_difference_px = sum / static_cast<double>(compared);
}

BusFigures sum_up_bus(const GameLog& game) {
  BusFigures sum;
  for (const auto& service : game.counters) {
    const auto add = [&](std::int64_t& to, const char* name) {
      to += game.counter(service.first, name).value_or(0);
    };
    add(sum.received, "messages_received");
    add(sum.lost, "messages_lost");
    add(sum.late, "messages_late");
    add(sum.duplicate, "messages_duplicate");
    add(sum.rejected, "messages_rejected");
    add(sum.foreign, "messages_foreign");
    add(sum.left_out, StatusReporter::kLeftOut);
  }
  return sum;
}

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

void add(Json& json, const std::string& name, const std::optional<LoggedLatency>& latency) {
  json[name + "_p50_us"] = latency ? Json(latency->p50_us) : Json(nullptr);
  json[name + "_p99_us"] = latency ? Json(latency->p99_us) : Json(nullptr);
  json[name + "_max_us"] = latency ? Json(latency->max_us) : Json(nullptr);
}

Json to_json(const DemoFigures& f) {
  Json json;
  json["events_sent"] = or_null(f.events_sent);
  json["events_received"] = or_null(f.events_received);
  json["events_lost"] = or_null(f.events_lost);
  json["estimates"] = f.estimates;
  json["estimate_rate_hz"] = or_null(f.estimate_rate_hz);
  json["mean_px"] = or_null(f.mean_px);
  json["median_px"] = or_null(f.median_px);
  json["p95_px"] = or_null(f.p95_px);
  json["lost_percent"] = or_null(f.lost_percent);
  add(json, "packet_to_estimate", f.packet_to_estimate);
  add(json, "sensor_to_estimate", f.sensor_to_estimate);
  add(json, "backlog", f.backlog);
  json["messages_received"] = f.bus.received;
  json["messages_lost"] = f.bus.lost;
  json["messages_late"] = f.bus.late;
  json["messages_duplicate"] = f.bus.duplicate;
  json["messages_rejected"] = f.bus.rejected;
  json["messages_foreign"] = f.bus.foreign;
  json["counters_left_out"] = f.bus.left_out;
  json["shots"] = or_null(f.shots);
  json["saves"] = or_null(f.saves);
  json["goals_against"] = or_null(f.goals_against);
  json["replay_estimates"] = or_null(f.replay_estimates);
  json["replay_mean_difference_px"] = or_null(f.replay_mean_difference_px);
  return json;
}

}  // namespace

DemoFigures demo_figures(const GameLog& game, const GameLog* replay) {
  DemoFigures figures;
  figures.events_sent = game.counter("puck-camera", "events_sent");
  figures.events_received = game.counter("puck-tracker", "events_received");
  if (figures.events_sent && figures.events_received) {
    figures.events_lost = *figures.events_sent - *figures.events_received;
  }
  figures.estimates = static_cast<std::int64_t>(game.estimates.size());
  const std::vector<puck_estimate_t> estimates = with_news(game.estimates);
  if (estimates.size() > 1) {
    const auto span_us = estimates.back().utime - estimates.front().utime;
    figures.estimate_rate_hz =
        static_cast<double>(estimates.size() - 1) / (static_cast<double>(span_us) * 1e-6);
  }
  std::optional<TruthTrack> truth;
  if (game.truth.size() > 1) truth.emplace(game.truth);
  if (truth) score(*truth, estimates, figures);
  figures.packet_to_estimate = game.latency("puck-tracker", "packet_to_estimate");
  figures.sensor_to_estimate = game.latency("puck-tracker", "sensor_to_estimate");
  figures.estimate_to_command = game.latency("puck-bridge", "estimate_to_command");
  figures.backlog = game.latency("puck-tracker", "backlog");
  figures.bus = sum_up_bus(game);
  if (game.last_truth) {
    figures.shots = game.last_truth->shots;
    figures.saves = game.last_truth->saves;
    figures.goals_against = game.last_truth->goals_against;
  }
  if (game.last_game) {
    figures.believed_shots = game.last_game->shots;
    figures.believed_saves = game.last_game->saves;
    figures.believed_goals_against = game.last_game->goals_against;
  }
  if (replay != nullptr) compare(estimates, *replay, truth, figures);
  return figures;
}

void write_json(const DemoFigures& figures, const std::filesystem::path& path) {
  // An interrupted run leaves the old file or the new one; a pipe cannot be replaced.
  const bool replaces = !std::filesystem::exists(path) || std::filesystem::is_regular_file(path);
  std::filesystem::path written = path;
  if (replaces) written += ".part";
  std::ofstream file(written);
  file << to_json(figures).dump(2) << '\n';
  file.close();
  std::error_code error;
  if (file && replaces) std::filesystem::rename(written, path, error);
  if (file && !error) return;
  if (replaces) std::filesystem::remove(written, error);
  throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace puck
