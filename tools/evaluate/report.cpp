#include "tools/evaluate/report.h"

#include <cstdio>

#include <nlohmann/json.hpp>

#include "common/io/text_file.h"

namespace puck {
namespace {

using Json = nlohmann::ordered_json;

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

void add_covariance(Json& json, const std::optional<CovarianceReport>& covariance) {
  json["nees_mean"] = covariance ? Json(covariance->nees_mean) : Json(nullptr);
  json["nees_median"] = covariance ? Json(covariance->nees_median) : Json(nullptr);
  json["nees_within_95_percent"] =
      covariance ? Json(covariance->nees_within_95_percent) : Json(nullptr);
}

void add_score_curve(Json& json, const ScoreCurve* curve) {
  json["score_threshold"] = curve ? Json(curve->best().threshold) : Json(nullptr);
  json["score_precision"] = curve ? Json(curve->best().precision) : Json(nullptr);
  json["score_recall"] = curve ? Json(curve->best().recall) : Json(nullptr);
  json["score_average_precision"] = curve ? Json(curve->average_precision()) : Json(nullptr);
}

void add_replay(Json& json, const ReplayComparison& replay) {
  json["replay_estimates"] = replay.estimates;
  json["replay_repeated"] = replay.repeated;
  json["replay_equal"] = replay.equal;
  json["replay_state_differs"] = replay.state_differs;
  json["replay_mean_difference_px"] = or_null(replay.mean_difference_px);
  json["replay_max_difference_px"] = or_null(replay.max_difference_px);
}

Json to_json(const EvaluationReport& report) {
  Json json;
  json["algorithm"] = report.algorithm;
  json["preset"] = or_null(report.preset);
  json["events"] = report.run.events;
  json["duration_s"] = report.run.duration_s;
  const auto& errors = report.errors;
  json["estimates"] = errors ? Json(errors->estimates) : Json(nullptr);
  const auto measured = [&](const char* key, double ErrorStatistics::*value) {
    json[key] = errors && errors->estimates > 0 ? Json((*errors).*value) : Json(nullptr);
  };
  measured("mean_px", &ErrorStatistics::mean_px);
  measured("median_px", &ErrorStatistics::median_px);
  measured("p95_px", &ErrorStatistics::p95_px);
  measured("within_2px_percent", &ErrorStatistics::within_2px_percent);
  measured("within_3p5px_percent", &ErrorStatistics::within_3p5px_percent);
  measured("within_4px_percent", &ErrorStatistics::within_4px_percent);
  const auto& accuracy = report.accuracy;
  const bool scored = accuracy && accuracy->estimates > 0;
  json["lost_percent"] = scored ? Json(accuracy->lost_percent) : Json(nullptr);
  json["said_and_wrong_percent"] = or_null(report.said_and_wrong_percent);
  json["longest_loss_ms"] = scored ? Json(accuracy->longest_loss_ms) : Json(nullptr);
  json["time_to_first_track_ms"] =
      accuracy ? or_null(accuracy->time_to_first_track_ms) : Json(nullptr);
  const auto& latency = report.run.latency;
  json["latency_p50_us"] = latency ? Json(latency->p50_us) : Json(nullptr);
  json["latency_p99_us"] = latency ? Json(latency->p99_us) : Json(nullptr);
  json["throughput_mev_s"] = or_null(report.run.throughput_mev_s);
  json["cpu_us_per_ms"] = or_null(report.run.cpu_us_per_ms);
  json["mev_s"] = report.run.duration_s > 0
                      ? Json(static_cast<double>(report.run.events) * 1e-6 / report.run.duration_s)
                      : Json(nullptr);
  measured("p5_px", &ErrorStatistics::p5_px);
  measured("p25_px", &ErrorStatistics::p25_px);
  measured("p75_px", &ErrorStatistics::p75_px);
  measured("max_px", &ErrorStatistics::max_px);
  json["scoring"] = errors ? Json(report.scoring) : Json(nullptr);
  measured("std_px", &ErrorStatistics::std_px);
  json["truth_gap_percent"] = accuracy ? Json(accuracy->truth_gap_percent) : Json(nullptr);
  json["settle_ms"] = accuracy ? Json(accuracy->settle_ms) : Json(nullptr);
  add_covariance(json, scored ? accuracy->covariance : std::nullopt);
  add_score_curve(json, errors && errors->estimates > 0 ? &errors->score_curve : nullptr);
  if (report.paper) {
    json["truth_rows"] = report.paper->truth_rows;
    json["below_0_to_29px_percent"] = report.paper->below_percent;
  }
  if (report.replay) add_replay(json, *report.replay);
  return json;
}

}  // namespace

void print(const EvaluationReport& report) {
  const Json json = to_json(report);
  for (const auto& [key, value] : json.items()) {
    if (value.is_null()) {
      std::printf("%-24s -\n", key.c_str());
    } else if (value.is_number_float()) {
      std::printf("%-24s %.3f\n", key.c_str(), value.get<double>());
    } else if (value.is_string()) {
      std::printf("%-24s %s\n", key.c_str(), value.get<std::string>().c_str());
    } else {
      std::printf("%-24s %s\n", key.c_str(), value.dump().c_str());
    }
  }
}

void write_json(const EvaluationReport& report, const std::filesystem::path& path) {
  write_text_file(path, to_json(report).dump(2) + '\n');
}

}  // namespace puck
