#include "tools/evaluate/picture.h"

#include <string>

#include <nlohmann/json.hpp>

#include "common/io/text_file.h"
#include "tools/charts/draw_charts.h"

namespace puck {
namespace {

using MomentJson = nlohmann::ordered_json;

// Trail points with a longer gap are not joined.
constexpr std::int64_t kLongestGapUs = 20'000;

std::string state_of(const PuckEstimate& estimate) {
  std::string text = to_string(estimate.state);
  if (estimate.resting) text += ", resting";
  if (estimate.coasting) text += ", coasting";
  if (estimate.left_image) text += ", left the image";
  return text;
}

MomentJson ellipse_json(Pixel centre, PuckSize size) {
  return {{"x", centre.x}, {"y", centre.y}, {"width", size.width}, {"height", size.height}};
}

// x, y, polarity, age in µs.
MomentJson events_json(const TrackedMoment& moment) {
  MomentJson rows = MomentJson::array();
  for (const Event& event : moment.events.events) {
    const std::int64_t age_us = moment.time - moment.events.time_of(event);
    if (age_us < 0 || age_us >= TrackedMoment::kEventsUs) continue;
    if (!moment.sensor.contains(event.x, event.y)) continue;
    rows.push_back({event.x, event.y, event.polarity, age_us});
  }
  return rows;
}

// Lines from one point to the next: x, y, x, y, age in µs of its end.
MomentJson trail_json(const TrackedMoment& moment) {
  MomentJson rows = MomentJson::array();
  for (std::size_t i = 1; i < moment.trail.size(); ++i) {
    const auto& from = moment.trail[i - 1];
    const auto& to = moment.trail[i];
    const std::int64_t age_us = moment.time - to.time;
    if (age_us < 0 || age_us > TrackedMoment::kTrailUs) continue;
    if (!from.position || !to.position || to.time - from.time > kLongestGapUs) continue;
    rows.push_back({from.position->x, from.position->y, to.position->x, to.position->y, age_us});
  }
  return rows;
}

}  // namespace

void write_moment(const TrackedMoment& moment, const std::filesystem::path& path) {
  const PuckEstimate& estimate = moment.estimate;
  MomentJson json{{"sensor", {moment.sensor.width, moment.sensor.height}},
                  {"time_s", moment.seconds},
                  {"state", state_of(estimate)},
                  {"estimate", nullptr},
                  {"truth", nullptr},
                  {"events_us", TrackedMoment::kEventsUs},
                  {"events", events_json(moment)},
                  {"trail_us", TrackedMoment::kTrailUs},
                  {"trail", trail_json(moment)}};
  if (estimate.position) {
    json["estimate"] = ellipse_json(*estimate.position, estimate.size);
    json["estimate"].update({{"vx", estimate.velocity.x}, {"vy", estimate.velocity.y}});
  }
  if (moment.truth) json["truth"] = ellipse_json(moment.truth->centre, moment.truth->size);
  write_text_file(path, json.dump() + '\n');
}

void draw_picture(const TrackedMoment& moment, const std::filesystem::path& path) {
  const std::filesystem::path data = path.string() + ".json";
  write_moment(moment, data);
  draw_charts("picture", {data, path});
  std::filesystem::remove(data);
}

}  // namespace puck
