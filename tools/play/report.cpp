#include "tools/play/report.h"

#include <cstdio>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "common/io/text_file.h"

namespace puck {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json to_json(const SaveFigures& f) {
  const Interval interval = wilson_interval(f.saves, f.shots);
  Json json;
  json["shots"] = f.shots;
  json["saves"] = f.saves;
  json["goals"] = f.goals;
  json["save_percent"] = f.shots > 0 ? Json(f.save_percent()) : Json(nullptr);
  json["save_ci_low"] = 100 * interval.low;
  json["save_ci_high"] = 100 * interval.high;
  json["bound_percent"] = or_null(f.bound_percent());
  json["waiting_percent"] = or_null(f.waiting_percent());
  json["mean_shot_speed_m_s"] = or_null(f.mean_speed_m_s());
  for (std::size_t i = 0; i < kGoalCauses; ++i) {
    json["goals_" + std::string(to_string(static_cast<GoalCause>(i)))] =
        f.causes ? Json((*f.causes)[i]) : Json(nullptr);
  }
  json["game_shots"] = f.believed_shots;
  json["game_saves"] = f.believed_saves;
  json["game_goals_against"] = f.believed_goals;
  json["played_s"] = f.played_s;
  json["speed_x"] = f.speed_x();
  return json;
}

void write(const Json& json, const std::filesystem::path& path) {
  write_text_file(path, json.dump(2) + '\n');
}

std::string percent_of(std::int64_t part, std::int64_t of) {
  char text[80];
  const Interval interval = wilson_interval(part, of);
  std::snprintf(text, sizeof text, "%5.1f %%  (95 %%: %.1f to %.1f)",
                of > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(of) : 0.0,
                100 * interval.low, 100 * interval.high);
  return text;
}

void row(const char* what, std::int64_t value) {
  std::printf("  %-44s %6lld\n", what, static_cast<long long>(value));
}

}  // namespace

void print(const SaveFigures& f) {
  std::printf("  %-44s %6s %8s\n", "", "game", "GAME says");
  const auto both = [](const char* what, std::int64_t truth, std::int64_t believed) {
    std::printf("  %-44s %6lld %8lld\n", what, static_cast<long long>(truth),
                static_cast<long long>(believed));
  };
  both("shots at the robot's goal", f.shots, f.believed_shots);
  both("saves", f.saves, f.believed_saves);
  both("goals against the robot", f.goals, f.believed_goals);
  std::printf("  %-44s %s\n", "saved", percent_of(f.saves, f.shots).c_str());
  if (f.reachable && f.causes) {
    std::printf("  %-44s %s\n", "best arm, with the crossing known at the hit",
                percent_of(*f.reachable, f.shots).c_str());
    std::printf("  %-44s %s\n", "mallet at rest in the middle",
                percent_of(f.waiting.value_or(0), f.shots).c_str());
    if (f.goals > 0) std::printf("  causes of the goals:\n");
    for (std::size_t i = 0; i < kGoalCauses; ++i) {
      if ((*f.causes)[i] == 0) continue;
      std::string name(to_string(static_cast<GoalCause>(i)));
      for (char& letter : name) letter = letter == '_' ? ' ' : letter;
      row(("  " + name).c_str(), (*f.causes)[i]);
    }
    std::printf("  %-44s %6.2f m/s\n", "mean speed of the shots", f.mean_speed_m_s().value_or(0));
  }
  std::printf("  %-44s %6.1f s, %.1f times as fast as real time\n", "played", f.played_s,
              f.speed_x());
}

void write_json(const SaveFigures& figures, const std::filesystem::path& path) {
  write(to_json(figures), path);
}

void print(const Sweep& sweep) {
  std::printf("  %-28s %22s %8s    %s\n", "curve", sweep.axis.c_str(), "bound %", "saved");
  for (const SweepPoint& point : sweep.points) {
    std::printf("  %-28s %22g %8.1f    %s\n", point.curve.c_str(), point.value,
                point.figures.bound_percent().value_or(0),
                percent_of(point.figures.saves, point.figures.shots).c_str());
  }
}

void write_json(const Sweep& sweep, const std::filesystem::path& path) {
  Json points = Json::array();
  for (const SweepPoint& point : sweep.points) {
    Json json;
    json["value"] = point.value;
    json["curve"] = point.curve;
    json.update(to_json(point.figures));
    points.push_back(json);
  }
  write({{"sweep", sweep.name},
         {"axis", sweep.axis},
         {"logarithmic", sweep.is_logarithmic},
         {"points", points}},
        path);
}

}  // namespace puck
