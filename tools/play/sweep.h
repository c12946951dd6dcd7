#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/play/play_setup.h"
#include "tools/play/save_figures.h"

namespace puck {

struct SweepPoint {
  std::string curve;
  double value = 0;
  SaveFigures figures;
};

/// How the save rate falls as one thing grows, for several trackers on the same shots.
struct Sweep {
  std::string name;  ///< `latency`, `speed`, `rate` or `loss`.
  std::string axis;  ///< What `value` is, with its unit.
  bool is_logarithmic = false;
  std::vector<SweepPoint> points;  ///< Curve by curve, values growing.
};

/// Which points a sweep has, before they are measured.
struct PlannedSweep {
  struct Point {
    std::string curve;
    double value = 0;
    PlaySetup setup;
  };
  std::string name;
  std::string axis;
  bool is_logarithmic = false;
  std::vector<Point> points;
};

/// The sweep of that name around a setup. `max_speed_m_s`: of the shots, where that is not what is
/// swept. Throws std::invalid_argument for another name.
PlannedSweep plan_sweep(const std::string& name, const PlaySetup& setup, double max_speed_m_s);

struct SweepSettings {
  int shots = 200;  ///< A point.
  std::int64_t seed = 1;
  int jobs = 1;
};
/// Plays it. The same shots are played at all points with the same speed. `on_point` is called with
/// each as soon as it is measured.
Sweep run_sweep(const PlannedSweep& plan, const SweepSettings& settings,
                const std::function<void(const SweepPoint&)>& on_point);

}  // namespace puck
