#include "tools/play/plots.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "common/plot/chart.h"

namespace puck {
namespace {

constexpr double kMostPercent = 105;
// Offset between the points of curves, so that their intervals do not overlap.
constexpr double kApart = 0.003;

Axis axis_of(const Sweep& sweep) {
  double smallest = sweep.points.front().value;
  double largest = smallest;
  for (const SweepPoint& point : sweep.points) {
    smallest = std::min(smallest, point.value);
    largest = std::max(largest, point.value);
  }
  if (sweep.is_logarithmic) return logarithmic_axis(sweep.axis, smallest, largest);
  const double spare = 0.03 * largest;
  return {.label = sweep.axis, .from = -spare, .to = largest + spare};
}

std::vector<std::string> curves_of(const Sweep& sweep) {
  std::vector<std::string> names;
  for (const SweepPoint& point : sweep.points) {
    if (names.empty() || names.back() != point.curve) names.push_back(point.curve);
  }
  return names;
}

// Shifts a value to the right by the share `shift` of the axis.
double shifted(const Sweep& sweep, const Axis& axis, double value, double shift) {
  if (!sweep.is_logarithmic) return value + shift * (axis.to - axis.from);
  return value * std::pow(axis.to / axis.from, shift);
}

void draw_limits(const Sweep& sweep, Chart& chart) {
  std::vector<Chart::Point> bound;
  std::vector<Chart::Point> waiting;
  for (const SweepPoint& point : sweep.points) {
    if (point.curve != sweep.points.front().curve) break;
    bound.push_back({point.value, point.figures.bound_percent().value_or(0)});
    waiting.push_back({point.value, point.figures.waiting_percent().value_or(0)});
  }
  chart.line(bound, kBlack, 1);
  chart.line(waiting, kGrey, 1);
}

void draw_curve(const Sweep& sweep, const Axis& axis, const std::string& name, double shift,
                Ink ink, Chart& chart) {
  std::vector<Chart::Point> line;
  for (const SweepPoint& point : sweep.points) {
    if (point.curve != name) continue;
    const double x = shifted(sweep, axis, point.value, shift);
    const Interval interval = wilson_interval(point.figures.saves, point.figures.shots);
    line.push_back({x, point.figures.save_percent()});
    chart.line({{x, 100 * interval.low}, {x, 100 * interval.high}}, ink, 1);
  }
  chart.line(line, ink);
}

// Class of a shot's outcome, and its colour.
struct Fate {
  const char* name;
  Ink ink;
};

Fate fate_of(const ShotOutcome& outcome) {
  if (outcome.end == ShotOutcome::End::kSaved) return {"saved", series_ink(0)};
  if (outcome.end == ShotOutcome::End::kUnjudged) return {"not judged", kGrey};
  if (outcome.cause == GoalCause::kNotReachable) return {"unreachable goal", kBlack};
  return {"goal", series_ink(1)};
}

}  // namespace

void write_plot(const Sweep& sweep, const std::filesystem::path& folder) {
  if (sweep.points.empty()) return;
  std::filesystem::create_directories(folder);
  const Axis axis = axis_of(sweep);
  const std::vector<std::string> curves = curves_of(sweep);
  constexpr std::size_t kFewCurves = 4;
  Chart chart("shots saved, %, with 95 % intervals", axis,
              {.label = "saved, %", .to = kMostPercent},
              {.width_px = curves.size() > kFewCurves ? 1400 : 1000, .height_px = 560});
  draw_limits(sweep, chart);
  chart.legend("best arm", kBlack);
  chart.legend("waits in the middle", kGrey);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const double shift = kApart * (static_cast<double>(i) - static_cast<double>(curves.size()) / 2);
    draw_curve(sweep, axis, curves[i], shift, series_ink(i), chart);
    chart.legend(curves[i], series_ink(i));
  }
  chart.save(folder / ("saves_" + sweep.name + ".png"));
}

void write_plot(const std::vector<ShotFacts>& shots, const std::vector<ShotOutcome>& outcomes,
                const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  double fastest_m_s = 0;
  double widest_m = 0;
  for (const ShotFacts& shot : shots) {
    fastest_m_s = std::max(fastest_m_s, shot.speed_m_s);
    widest_m = std::max(widest_m, std::abs(shot.crossing_y_m));
  }
  widest_m *= 1.1;
  Chart chart("outcome of the shots", axis_from_zero("speed after the hit, m/s", fastest_m_s),
              {.label = "crosses at, m", .from = -widest_m, .to = widest_m},
              {.width_px = 1000, .height_px = 560});
  std::set<std::string> told;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const Fate fate = fate_of(outcomes[i]);
    if (told.insert(fate.name).second) chart.legend(fate.name, fate.ink);
    chart.mark({shots[i].speed_m_s, shots[i].crossing_y_m}, "", fate.ink);
  }
  chart.save(folder / "shots.png");
}

}  // namespace puck
