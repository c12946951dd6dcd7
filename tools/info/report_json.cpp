#include <nlohmann/json.hpp>

#include "tools/info/report.h"

namespace puck {
namespace {

using Json = nlohmann::ordered_json;

Json json_of_rates(const RateHistory& rates) {
  return {{"bin_us", rates.bin_us()}, {"events", rates.bins()}};
}

Json json_of_gaps(const Survey& survey) {
  Json gaps = Json::array();
  for (const EventGap& gap : survey.gaps) {
    gaps.push_back({{"from_us", gap.from.us}, {"length_us", gap.length_us}});
  }
  return gaps;
}

Json json_of_hot_pixels(const HotPixelReport& report) {
  Json pixels = Json::array();
  for (const HotPixel& pixel : report.pixels) {
    pixels.push_back({{"x", pixel.place.x}, {"y", pixel.place.y}, {"rate_hz", pixel.rate_hz}});
  }
  return pixels;
}

}  // namespace

std::string survey_json(const Survey& survey, bool with_pixels) {
  const EventCounters& counters = survey.counters;
  Json json;
  json["file"] = survey.name;
  json["encoding"] = survey.facts.encoding;
  json["bytes"] = survey.bytes ? Json(*survey.bytes) : Json();
  json["header"] = Json::array();
  for (const auto& [key, value] : survey.facts.header) json["header"].push_back({key, value});
  json["width"] = survey.sensor.width;
  json["height"] = survey.sensor.height;
  json["events"] = counters.events;
  const bool has_events = counters.events > 0;
  json["first_us"] = has_events ? Json(survey.first.us) : Json();
  json["last_us"] = has_events ? Json(survey.last.us) : Json();
  json["duration_s"] = has_events ? Json(survey.seconds()) : Json();
  json["rate_mev_s"] = survey.seconds() > 0
                           ? Json(static_cast<double>(counters.events) * 1e-6 / survey.seconds())
                           : Json();
  json["on_percent"] = has_events ? Json(100.0 * static_cast<double>(survey.brighter) /
                                         static_cast<double>(counters.events))
                                  : Json();
  json["time_step_us"] = survey.time_step_us;
  json["time_wraps"] = counters.time_wraps;
  json["gaps_of_10_ms"] = survey.gap_count;
  json["longest_gaps"] = json_of_gaps(survey);
  json["hot_pixels"] = survey.hot_pixels ? json_of_hot_pixels(*survey.hot_pixels) : Json();
  json["skipped"] = {
      {"before_start", counters.before_start},   {"outside_sensor", counters.outside_sensor},
      {"backwards", counters.backwards},         {"missing", counters.missing},
      {"other_data", counters.other_data},       {"malformed", counters.malformed_words},
      {"time_glitches", counters.time_glitches}, {"truncated_bytes", counters.truncated_bytes}};
  json["rates"] = json_of_rates(survey.rates);
  json["warnings"] = survey.warnings;
  json["problems"] = survey.problems;
  if (with_pixels) json["pixel_counts"] = survey.pixel_counts;
  // A header may hold any bytes.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace puck
