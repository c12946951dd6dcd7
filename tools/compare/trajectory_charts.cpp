#include "tools/compare/trajectory_charts.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace puck {
namespace {

constexpr double kShownSeconds = 4;
constexpr double kMotionPx = 5;
constexpr int kTruthWidthPx = 6;
constexpr Ink kTruthInk{205, 205, 205};
constexpr ChartSize kTimeSize{1400, 360};
constexpr ChartSize kImageSize{1400, 700};

// Shortly before the puck first moves.
double begin_of(const Trajectory& truth) {
  if (truth.rows.empty()) return 0;
  const auto& first = truth.rows.front();
  const auto moved = std::find_if(truth.rows.begin(), truth.rows.end(), [&](const auto& row) {
    return std::hypot(row.x - first.x, row.y - first.y) > kMotionPx;
  });
  return moved == truth.rows.end() ? first.time_s : std::max(moved->time_s - 0.1, first.time_s);
}

struct Span {
  double low = 1e9;
  double high = -1e9;
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  // With a margin, so that the span is never empty.
  Span padded() const {
    if (high < low) return {0, 1};
    const double edge = 0.08 * (high - low) + 1;
    return {low - edge, high + edge};
  }
};

struct Drawn {
  std::string name;
  Trajectory trajectory;
  Ink ink;
  int width_px = 1;
};

void write_one(const RecordingResult& recording, const std::vector<Drawn>& all,
               const std::filesystem::path& folder) {
  const Trajectory& truth = all.front().trajectory;
  const double begin_s = begin_of(truth);
  const double end_s = begin_s + std::min(kShownSeconds, recording.seconds);
  const auto shown = [&](const Trajectory::Row& row) {
    return row.time_s >= begin_s && row.time_s <= end_s;
  };
  Span xs;
  Span ys;
  for (const auto& row : truth.rows) {
    if (!shown(row)) continue;
    xs.add(row.x);
    ys.add(row.y);
  }
  const Span x = xs.padded();
  const Span y = ys.padded();
  const Axis time{.label = "sensor time, s", .from = begin_s, .to = end_s};
  const std::string which = recording.set + ", seed " + std::to_string(recording.seed);
  std::vector<Chart> charts{
      Chart("x over time, " + which, time, {.label = "x, px", .from = x.low, .to = x.high},
            kTimeSize),
      Chart("y over time, " + which, time, {.label = "y, px", .from = y.low, .to = y.high},
            kTimeSize),
      // Image rows grow downwards.
      Chart("in the image, " + which, {.label = "x, px", .from = x.low, .to = x.high},
            {.label = "y, px", .from = y.high, .to = y.low}, kImageSize)};
  for (const Drawn& drawn : all) {
    std::vector<Chart::Point> over_time_x;
    std::vector<Chart::Point> over_time_y;
    std::vector<Chart::Point> in_image;
    for (const auto& row : drawn.trajectory.rows) {
      if (!shown(row)) continue;
      over_time_x.push_back({row.time_s, row.x});
      over_time_y.push_back({row.time_s, row.y});
      in_image.push_back({row.x, row.y});
    }
    charts[0].line(over_time_x, drawn.ink, drawn.width_px);
    charts[1].line(over_time_y, drawn.ink, drawn.width_px);
    charts[2].line(in_image, drawn.ink, drawn.width_px);
    for (Chart& chart : charts) chart.legend(drawn.name, drawn.ink);
  }
  save_stacked(charts, folder / ("trajectories-" + recording.set + ".png"));
}

}  // namespace

void write_trajectories(const Comparison& comparison, const std::filesystem::path& folder) {
  for (const RecordingResult& recording : comparison.recordings()) {
    if (!recording.shown) continue;
    std::vector<Drawn> all{
        {"truth", read_true_trajectory(recording.folder / "truth.csv"), kTruthInk, kTruthWidthPx}};
    std::size_t number = 0;
    for (const Contestant& contestant : contestants()) {
      for (const RunFigures* run : comparison.runs({recording.set}, contestant.name)) {
        if (run->result().seed != recording.seed) continue;
        all.push_back(
            {contestant.name, read_ticks(run->result().folder / "ticks.csv"), series_ink(number)});
      }
      ++number;
    }
    write_one(recording, all, folder);
  }
}

}  // namespace puck
