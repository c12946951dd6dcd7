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

/// The save rate as a function of one quantity, for several trackers on the same shots.
struct Sweep {
  std::string name;  ///< `latency`, `speed`, `rate` or `loss`.
  std::string axis;  ///< Name of `value`, with its unit.
  bool is_logarithmic = false;
  std::vector<SweepPoint> points;  ///< Curve by curve, in ascending order.
};

/// The points of a sweep, before their measurement.
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

/// The sweep of that name around a setup. `max_speed_m_s`: maximum speed of the shots, unless
/// swept. Throws std::invalid_argument for another name.
PlannedSweep plan_sweep(const std::string& name, const PlaySetup& setup, double max_speed_m_s);

struct SweepSettings {
  int shots = 200;  ///< Per point.
  std::int64_t seed = 1;
  int jobs = 1;
};
/// Plays a sweep, with the same shots at all points of equal speed. Calls `on_point` after each
/// point.
Sweep run_sweep(const PlannedSweep& plan, const SweepSettings& settings,
                const std::function<void(const SweepPoint&)>& on_point);

}  // namespace puck
