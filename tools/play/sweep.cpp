#include "tools/play/sweep.h"

#include <map>
#include <stdexcept>
#include <utility>

#include "tools/play/shot_series.h"

namespace puck {
namespace {

struct Curve {
  std::string name;
  PlaySetup setup;
};

Curve puck_curve(PlaySetup setup, std::int64_t more_us = 0) {
  setup.link.latency_us += more_us;
  if (more_us == 0) return {"PUCK", setup};
  return {"PUCK +" + std::to_string(more_us / 1000) + " ms", setup};
}

Curve frame_curve(PlaySetup setup, int rate_hz) {
  setup.source = EstimateSource::kFrames;
  setup.frames.rate_hz = rate_hz;
  return {"camera, " + std::to_string(rate_hz) + " Hz", setup};
}

template <typename Set>
void add_points(PlannedSweep& plan, const std::vector<Curve>& curves,
                const std::vector<double>& values, const Set& set) {
  for (const Curve& curve : curves) {
    for (const double value : values) {
      PlannedSweep::Point point{curve.name, value, curve.setup};
      set(point.setup, value);
      plan.points.push_back(std::move(point));
    }
  }
}

}  // namespace

PlannedSweep plan_sweep(const std::string& name, const PlaySetup& around, double max_speed_m_s) {
  PlaySetup setup = for_single_shots(around);
  set_shot_speed(setup.world.game, max_speed_m_s);
  PlannedSweep plan;
  plan.name = name;
  if (name == "latency") {
    plan.axis = "added latency, ms";
    add_points(plan,
               {puck_curve(setup), frame_curve(setup, 200), frame_curve(setup, 60),
                frame_curve(setup, 30)},
               {0, 4, 10, 20, 35, 50, 75, 100},
               [](PlaySetup& s, double ms) { s.link.latency_us += static_cast<int>(1000 * ms); });
  } else if (name == "speed") {
    plan.axis = "fastest shots, m/s";
    add_points(plan,
               {puck_curve(setup), puck_curve(setup, 4'000), puck_curve(setup, 20'000),
                puck_curve(setup, 50'000), frame_curve(setup, 200), frame_curve(setup, 60),
                frame_curve(setup, 30)},
               {2, 3, 4, 5, 6.5, 8, 11, 15},
               [](PlaySetup& s, double m_s) { set_shot_speed(s.world.game, m_s); });
  } else if (name == "rate") {
    plan.axis = "estimates a second, Hz";
    plan.is_logarithmic = true;
    add_points(plan,
               {puck_curve(setup), puck_curve(setup, 4'000), puck_curve(setup, 20'000),
                puck_curve(setup, 50'000)},
               {10, 20, 30, 60, 120, 200, 500, 1000, 2500, 5000},
               [](PlaySetup& s, double hz) { s.link.rate_hz = hz; });
  } else if (name == "loss") {
    plan.axis = "estimates lost, %";
    std::vector<Curve> curves{puck_curve(setup), puck_curve(setup), puck_curve(setup),
                              frame_curve(setup, 60)};
    curves[1].name += ", 20 ms bursts";
    curves[1].setup.link.burst_us = 20'000;
    curves[2].name += ", 100 ms bursts";
    curves[2].setup.link.burst_us = 100'000;
    add_points(plan, curves, {0, 10, 25, 50, 75, 90, 99},
               [](PlaySetup& s, double percent) { s.link.loss_percent = percent; });
  } else {
    throw std::invalid_argument("--sweep takes latency, speed, loss or rate, got " + name);
  }
  return plan;
}

Sweep run_sweep(const PlannedSweep& plan, const SweepSettings& settings,
                const std::function<void(const SweepPoint&)>& on_point) {
  Sweep sweep{plan.name, plan.axis, plan.is_logarithmic, {}};
  std::map<double, std::vector<ShotFacts>> shots_by_speed;
  for (const PlannedSweep::Point& planned : plan.points) {
    auto& shots = shots_by_speed[planned.setup.world.game.shot_speed_max_m_s];
    if (shots.empty()) {
      shots = find_shots(planned.setup, settings.seed, settings.shots, settings.jobs);
    }
    SweepPoint point{planned.curve, planned.value,
                     measure_saves(planned.setup, shots, settings.jobs)};
    on_point(point);
    sweep.points.push_back(std::move(point));
  }
  return sweep;
}

}  // namespace puck
