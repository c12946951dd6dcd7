#include "common/evaluation/prediction_score.h"

#include <algorithm>
#include <cmath>

#include "common/evaluation/quantile.h"

namespace puck {
namespace {

constexpr double kLongestS = static_cast<double>(PredictionReport::kBins) * PredictionReport::kBinS;
// Largest delay of a crossing that still matches its prediction.
constexpr double kMaxDelayS = 0.1;

double seconds_between(Timestamp from, Timestamp to) {
  return static_cast<double>(to - from) * 1e-6;
}

double percent(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? 100 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

}  // namespace

void PredictionScore::add(Timestamp t, const std::optional<Intercept>& predicted) {
  pending_.push_back({t, predicted});
}

void PredictionScore::crossed(Timestamp t, double y_m) {
  ++crossings_;
  for (const auto& [made, intercept] : pending_) {
    const double to_go_s = seconds_between(made, t);
    if (intercept) ++alarms_;
    if (!(to_go_s >= 0 && to_go_s < kLongestS)) continue;
    const auto bin = std::min(static_cast<std::size_t>(to_go_s / PredictionReport::kBinS),
                              PredictionReport::kBins - 1);
    ++moments_[bin];
    if (!intercept) {
      ++missing_[bin];
      continue;
    }
    Samples& samples = intercept->bounces == 0 ? direct_ : bounced_;
    samples[bin].push_back({std::abs(intercept->y_m - y_m), intercept->sigma_y_m,
                            std::abs(intercept->in_s - to_go_s), intercept->sigma_t_s});
  }
  pending_.clear();
}

void PredictionScore::interrupted(Timestamp t) {
  for (const auto& [made, intercept] : pending_) {
    if (!intercept) continue;
    ++alarms_;
    if (intercept->in_s < kLongestS && intercept->in_s + kMaxDelayS < seconds_between(made, t)) {
      ++false_alarms_;
    }
  }
  pending_.clear();
}

std::array<PredictionBin, PredictionReport::kBins> PredictionScore::bins_of(
    const Samples& samples) {
  std::array<PredictionBin, PredictionReport::kBins> bins;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    PredictionBin& bin = bins[i];
    bin.from_s = static_cast<double>(i) * PredictionReport::kBinS;
    bin.to_s = static_cast<double>(i + 1) * PredictionReport::kBinS;
    bin.predictions = static_cast<std::int64_t>(samples[i].size());
    if (samples[i].empty()) continue;
    std::vector<double> places;
    std::vector<double> times;
    std::array<std::int64_t, 4> within{};
    for (const Sample& sample : samples[i]) {
      places.push_back(sample.place_m);
      times.push_back(sample.time_s);
      within[0] += sample.place_m <= sample.sigma_m ? 1 : 0;
      within[1] += sample.place_m <= 2 * sample.sigma_m ? 1 : 0;
      within[2] += sample.time_s <= sample.sigma_s ? 1 : 0;
      within[3] += sample.time_s <= 2 * sample.sigma_s ? 1 : 0;
    }
    std::sort(places.begin(), places.end());
    std::sort(times.begin(), times.end());
    bin.median_m = quantile(places, 0.5);
    bin.p90_m = quantile(places, 0.9);
    bin.median_s = quantile(times, 0.5);
    bin.p90_s = quantile(times, 0.9);
    bin.within_1_sigma_percent = percent(within[0], bin.predictions);
    bin.within_2_sigma_percent = percent(within[1], bin.predictions);
    bin.time_within_1_sigma_percent = percent(within[2], bin.predictions);
    bin.time_within_2_sigma_percent = percent(within[3], bin.predictions);
  }
  return bins;
}

PredictionReport PredictionScore::report() const {
  PredictionReport report;
  report.crossings = crossings_;
  report.direct = bins_of(direct_);
  report.bounced = bins_of(bounced_);
  for (std::size_t i = 0; i < PredictionReport::kBins; ++i) {
    report.missing_percent[i] = percent(missing_[i], moments_[i]);
  }
  report.false_alarms = false_alarms_;
  report.alarms = alarms_;
  return report;
}

}  // namespace puck
