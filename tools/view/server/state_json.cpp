#include "tools/view/server/state_json.h"

#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

namespace puck {
namespace {

using ViewJson = nlohmann::ordered_json;

template <typename T>
ViewJson or_null(const std::optional<T>& value) {
  return value ? ViewJson(*value) : ViewJson();
}

/// Rounded, so that the text is short.
ViewJson rounded(double value, double steps) { return std::round(value * steps) / steps; }
ViewJson rounded(const std::optional<double>& value, double steps) {
  return value ? rounded(*value, steps) : ViewJson();
}

double seconds_between(Timestamp from, Timestamp to) {
  return static_cast<double>(to - from) / 1e6;
}

const char* name_of(ViewMessage::Level level) {
  constexpr std::array kNames{"info", "warning", "error"};
  return kNames.at(static_cast<std::size_t>(level));
}

const char* name_of(ViewPlayback::Activity activity) {
  constexpr std::array kNames{"playing", "paused", "seeking", "searching", "ended"};
  return kNames.at(static_cast<std::size_t>(activity));
}

ViewJson json_of(const PuckEstimate& estimate) {
  ViewJson json{
      {"state", to_string(estimate.state)},    {"resting", estimate.resting},
      {"coasting", estimate.coasting},         {"left_image", estimate.left_image.has_value()},
      {"score", rounded(estimate.score, 1e3)}, {"x_px", nullptr}};
  if (!estimate.position) return json;
  json["x_px"] = rounded(estimate.position->x, 1e2);
  json["y_px"] = rounded(estimate.position->y, 1e2);
  json["width_px"] = rounded(estimate.size.width, 1e2);
  json["height_px"] = rounded(estimate.size.height, 1e2);
  json["speed_px_s"] = rounded(std::hypot(estimate.velocity.x, estimate.velocity.y), 1);
  return json;
}

ViewJson json_of(const ViewLatency& latency) {
  return {{"name", latency.name},
          {"p50_us", or_null(latency.p50_us)},
          {"p99_us", or_null(latency.p99_us)},
          {"max_us", or_null(latency.max_us)}};
}

ViewJson json_of(const ViewService& service) {
  ViewJson json{{"name", service.name},
                {"host", service.host},
                {"pid", service.pid},
                {"state", service.state},
                {"state_text", service.state_text},
                {"healthy", service.is_healthy},
                {"age_s", rounded(service.age_s, 10)},
                {"uptime_s", rounded(service.uptime_s, 1)},
                {"counters", ViewJson::array()},
                {"latencies", ViewJson::array()}};
  for (const auto& [name, value] : service.counters) json["counters"].push_back({name, value});
  for (const ViewLatency& latency : service.latencies) {
    json["latencies"].push_back(json_of(latency));
  }
  return json;
}

ViewJson json_of(const ViewChannel& channel) {
  return {{"name", channel.name},
          {"messages_per_s", rounded(channel.messages_per_s, 10)},
          {"bytes_per_s", rounded(channel.bytes_per_s, 1)},
          {"received", channel.received},
          {"lost", channel.lost},
          {"late", channel.late},
          {"malformed", channel.malformed},
          {"age_s", rounded(channel.age_s, 10)},
          {"trouble", channel.is_in_trouble}};
}

ViewJson json_of(const std::vector<ChartSample>& samples) {
  const std::array<ViewJson, kViewSides> sides{ViewJson::array(), ViewJson::array()};
  ViewJson json{{"time_us", ViewJson::array()},
                {"events_per_s", ViewJson::array()},
                {"truth_x", ViewJson::array()},
                {"truth_y", ViewJson::array()},
                {"x", sides},
                {"y", sides},
                {"error", sides},
                {"doubtful", sides}};
  for (const ChartSample& sample : samples) {
    json["time_us"].push_back(sample.time.us);
    json["events_per_s"].push_back(rounded(sample.events_per_s, 1));
    json["truth_x"].push_back(sample.truth ? rounded(sample.truth->x, 10) : ViewJson());
    json["truth_y"].push_back(sample.truth ? rounded(sample.truth->y, 10) : ViewJson());
    for (std::size_t side = 0; side < sample.tracks.size(); ++side) {
      const ChartSample::Track& track = sample.tracks.at(side);
      json["x"][side].push_back(track.position ? rounded(track.position->x, 10) : ViewJson());
      json["y"][side].push_back(track.position ? rounded(track.position->y, 10) : ViewJson());
      json["error"][side].push_back(rounded(track.error_px, 1e2));
      json["doubtful"][side].push_back(track.is_doubtful ? 1 : 0);
    }
  }
  return json;
}

template <typename Rows>
ViewJson list_of(const Rows& rows) {
  ViewJson list = ViewJson::array();
  for (const auto& row : rows) list.push_back(json_of(row));
  return list;
}

std::string text_of(const ViewJson& json) {
  return json.dump(-1, ' ', false, ViewJson::error_handler_t::replace);
}

}  // namespace

std::string state_json(const ViewState& state) {
  ViewJson json{{"source", state.source},
                {"live", state.is_live},
                {"width", state.sensor.width},
                {"height", state.sensor.height},
                {"time_us", state.time.us},
                {"seconds", rounded(state.seconds, 1e6)},
                {"run", state.run},
                {"playback", nullptr},
                {"trackers", state.trackers},
                {"chosen", state.chosen},
                {"events_per_s", rounded(state.events_per_s, 1)},
                {"estimates", ViewJson::array()},
                {"errors_px", ViewJson::array()},
                {"samples", json_of(state.samples)},
                {"latencies", list_of(state.latencies)},
                {"services", list_of(state.services)},
                {"channels", list_of(state.channels)},
                {"messages", ViewJson::array()}};
  if (state.playback) {
    json["playback"] = {{"activity", name_of(state.playback->activity)},
                        {"speed", state.playback->speed},
                        {"reached_speed", rounded(state.playback->reached_speed, 1e3)}};
  }
  for (const auto& estimate : state.estimates) {
    json["estimates"].push_back(estimate ? json_of(*estimate) : ViewJson());
  }
  for (const auto& error : state.errors_px) json["errors_px"].push_back(rounded(error, 1e2));
  for (const ViewMessage& message : state.messages) {
    json["messages"].push_back({{"level", name_of(message.level)}, {"text", message.text}});
  }
  return text_of(json);
}

std::string timeline_json(const ViewTimeline& timeline) {
  const auto spans_of = [&](const auto& sides) {
    ViewJson all = ViewJson::array();
    for (const auto& spans : sides) {
      ViewJson list = ViewJson::array();
      for (const ViewTimeline::Span& span : spans) {
        list.push_back({seconds_between(timeline.first, span.begin),
                        seconds_between(timeline.first, span.end)});
      }
      all.push_back(std::move(list));
    }
    return all;
  };
  return text_of({{"seconds", seconds_between(timeline.first, timeline.last)},
                  {"complete", timeline.is_complete},
                  {"bin_s", static_cast<double>(timeline.bin_us) / 1e6},
                  {"events", timeline.events},
                  {"losses", spans_of(timeline.losses)},
                  {"examined", spans_of(timeline.examined)}});
}

}  // namespace puck
