// What a tracking step of the `reference` preset costs for pucks of many sizes: the whole step, as
// the tracking thread makes it on a copy of its region.

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/vision/paper/paper_presets.h"
#include "common/vision/paper/puck_pipeline.h"
#include "common/vision/surface/surface.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{640, 480};
constexpr Pixel kCentre{320, 240};
constexpr int kKernelMarginPx = 4;
constexpr std::int64_t kStepUs = 200;

// The puck's contour among noise.
std::vector<Event> events_around(double diameter_px) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Event> events;
  const auto add = [&](double x, double y) {
    events.push_back({static_cast<std::uint16_t>(std::lround(x)),
                      static_cast<std::uint16_t>(std::lround(y)), 0, 0});
  };
  for (int i = 0; i < 20'000; ++i) {
    add(share(random) * (kSensor.width - 1), share(random) * (kSensor.height - 1));
  }
  const int on_contour = static_cast<int>(10 * diameter_px);
  for (int i = 0; i < on_contour; ++i) {
    const double angle = 2 * std::numbers::pi * share(random);
    const double radius = diameter_px / 2 + share(random) - 0.5;
    add(kCentre.x + radius * std::cos(angle), kCentre.y + radius * std::sin(angle));
  }
  return events;
}

void measure(benchmark::State& state, int kernel_px) {
  PuckPipelineParams params = reference_params();
  params.kernels.smallest_px = 9;
  params.kernels.largest_px = 87;
  params.kernels.margin_x_px = kKernelMarginPx;
  params.kernels.margin_y_px = kKernelMarginPx;
  const double diameter_px = (kernel_px - kKernelMarginPx) / params.kernels.size_scale;
  PuckSizeModel size_model;
  size_model.width_0 = diameter_px;
  size_model.height_0 = diameter_px;

  Surface surface(kSensor, params.eros);
  surface.update(Timestamp{0}, events_around(diameter_px));
  PuckPipeline pipeline(kSensor, params, size_model);
  pipeline.take({.time = {0}, .request = {Region::all_of(kSensor)}, .candidates = {{kCentre, 1}}});

  SurfaceSnapshot snapshot;
  std::int64_t steps = 0;
  PuckEstimate estimate;
  for (auto _ : state) {
    if (!(snapshot.region == pipeline.region_needed())) {
      surface.snapshot(pipeline.region_needed(), snapshot);
    }
    // As if something new had happened: the pipeline looks no second time at what it has seen.
    snapshot.events_applied = ++steps;
    snapshot.newest_event = Timestamp{steps * kStepUs};
    estimate = pipeline.step(snapshot);
  }
  // The authors' ring is broad: a thin contour fits it equally well in a few places.
  if (!estimate.position || std::hypot(estimate.position->x - kCentre.x,
                                       estimate.position->y - kCentre.y) > diameter_px / 5) {
    state.SkipWithError("the puck is not where it was drawn");
  }
}

[[maybe_unused]] const bool registered = [] {
  for (const int kernel_px : {13, 19, 25, 31, 41, 51, 65, 79, 91}) {
    benchmark::RegisterBenchmark(("step_size_" + std::to_string(kernel_px) + "/ours").c_str(),
                                 measure, kernel_px);
  }
  return true;
}();

}  // namespace
}  // namespace puck
