#include "tools/compare/report_json.h"

#include <optional>
#include <string>
#include <vector>

namespace puck {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(std::optional<double> value) { return value ? Json(*value) : Json(nullptr); }

Json summary_json(const Summary& s) {
  Json json;
  json["sequences"] = s.sequences;
  json["estimates"] = s.ticks;
  json["mean_px"] = or_null(s.mean_px);
  json["mean_px_standard_error"] = or_null(s.mean_px_standard_error);
  json["median_sequence_mean_px"] = or_null(s.median_mean_px);
  json["worst_sequence_mean_px"] = or_null(s.worst_mean_px);
  json["within_3p5px_percent"] = or_null(s.within_3p5px_percent);
  json["within_4px_percent"] = or_null(s.within_4px_percent);
  json["std_px"] = or_null(s.std_px);
  json["lost_percent"] = or_null(s.lost_percent);
  json["lost_percent_standard_error"] = or_null(s.lost_percent_standard_error);
  json["said_and_wrong_percent"] = or_null(s.said_and_wrong_percent);
  json["longest_loss_ms"] = or_null(s.longest_loss_ms);
  json["time_to_first_track_ms"] = or_null(s.time_to_first_track_ms);
  json["nees_mean"] = or_null(s.nees_mean);
  json["nees_median"] = or_null(s.nees_median);
  json["nees_within_95_percent"] = or_null(s.nees_within_95_percent);
  json["cpu_us_per_ms"] = or_null(s.cpu_us_per_ms);
  json["mev_s"] = or_null(s.mev_s);
  return json;
}

Json runs_json(const std::vector<const RunFigures*>& runs) {
  Json json = Json::array();
  for (const RunFigures* run : runs) {
    Json one{{"seed", run->result().seed}, {"folder", run->result().folder.filename()}};
    one.update(run->json());
    json.push_back(one);
  }
  return json;
}

Json contestant_json(const ComparisonReport& report, const std::string& set,
                     const std::string& contestant) {
  Json json = summary_json(report.comparison.summary(set, contestant));
  json["runs"] = runs_json(report.comparison.runs({set}, contestant));
  return json;
}

Json set_json(const SequenceSet& set, const ComparisonReport& report) {
  Json json{{"title", set.title},
            {"moving", set.moving},
            {"hard", set.is_hard},
            {"first_seed", set.first_seed},
            {"seconds", seconds_of(set, report.options)},
            {"simulation_cpu_s_per_s", or_null(report.comparison.simulation_cost(set.name))}};
  for (const RecordingResult& recording : report.comparison.recordings()) {
    if (recording.set != set.name || !recording.shown) continue;
    json["shown"] = {{"seed", recording.seed},
                     {"seconds", recording.seconds},
                     {"folder", recording.folder.filename()}};
  }
  Json& all = json["contestants"];
  for (const Contestant& contestant : contestants()) {
    if (report.comparison.runs({set.name}, contestant.name).empty()) continue;
    all[contestant.name] = contestant_json(report, set.name, contestant.name);
  }
  return json;
}

Json goal_json(const GoalResult& goal) {
  const auto cell = [](const GoalCell& c) {
    const auto reached = c.reached();
    return Json{{"measured", or_null(c.measured)},
                {c.at_least ? "at_least" : "at_most", or_null(c.bar)},
                {"reached", reached ? Json(*reached) : Json(nullptr)}};
  };
  return {{"title", goal.title},
          {"reference", cell(goal.reference)},
          {"correlation", cell(goal.correlation)},
          {"default", cell(goal.by_default)}};
}

}  // namespace

Json report_json(const ComparisonReport& report) {
  Json json;
  json["sequences"] = report.options.sequences;
  json["seconds"] = report.options.seconds;
  json["scoring"] = report.options.scoring;
  json["goals"] = Json::array();
  for (const GoalResult& goal : check_goals(report.comparison)) {
    json["goals"].push_back(goal_json(goal));
  }
  for (const SequenceSet& set : sequence_sets()) {
    json["sets"][set.name] = set_json(set, report);
  }
  for (const Contestant& contestant : report.options.included()) {
    json["latency"][contestant.name] = runs_json(report.latency.runs({"latency"}, contestant.name));
  }
  return json;
}

}  // namespace puck
