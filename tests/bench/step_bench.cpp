// A tracking step of preset `reference`, against the same work done with OpenCV: the region
// blurred, the kernel's response at each of its pixels, shifted so that the lowest is 0, weighted
// with a Gaussian around the last position, and the place of the maximum within reach.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include "common/vision/correlation/kernel_bank.h"
#include "common/vision/paper/paper_presets.h"
#include "common/vision/paper/puck_tracker.h"
#include "common/vision/surface/surface.h"
#include "tests/support/kernel_weights.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{640, 480};
constexpr Pixel kExpected{320, 240};
constexpr int kSurfaces = 8;

// The kernel's canvas: the puck and 2 px on every side.
struct Distance {
  const char* name;
  int canvas_width;
  int canvas_height;
};
constexpr Distance kDistances[] = {{"far", 19, 11}, {"mid", 41, 31}, {"near", 65, 53}};

// What both forms of a step work with.
struct Task {
  PuckPipelineParams params = reference_params();
  PuckSizeModel size_model;
  std::vector<SurfaceSnapshot> surfaces;
  Region region;
  Region window;
};

// The puck's contour, near where it is expected, among noise.
SurfaceSnapshot surface_with_puck(const Task& task, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  Surface surface(kSensor, task.params.eros);
  std::vector<Event> events;
  const auto add = [&](double x, double y) {
    events.push_back({static_cast<std::uint16_t>(std::lround(x)),
                      static_cast<std::uint16_t>(std::lround(y)), 0, 0});
  };
  for (int i = 0; i < 20'000; ++i) {
    add(share(random) * (kSensor.width - 1), share(random) * (kSensor.height - 1));
  }
  const PuckSize size = task.size_model.at(kExpected);
  const Pixel centre{kExpected.x + 4 * share(random) - 2, kExpected.y + 4 * share(random) - 2};
  for (int i = 0; i < static_cast<int>(10 * size.width); ++i) {
    const double angle = 2 * std::numbers::pi * share(random);
    const double scale = 0.77 + 0.1 * share(random);
    add(centre.x + scale * size.width / 2 * std::cos(angle),
        centre.y + scale * size.height / 2 * std::sin(angle));
  }
  surface.update(Timestamp{0}, events);
  SurfaceSnapshot snapshot;
  surface.snapshot(task.region, snapshot);
  return snapshot;
}

Task task_at(const Distance& distance) {
  Task task;
  // Without the rounding to 256 levels the maximum is one pixel, which both forms must find.
  task.params.tracker.quantised = false;
  KernelBankParams& kernels = task.params.kernels;
  kernels.smallest_px = 7;
  kernels.largest_px = 61;
  kernels.size_scale = 1;
  task.size_model.width_0 = distance.canvas_width - kernels.margin_x_px;
  task.size_model.height_0 = distance.canvas_height - kernels.margin_y_px;
  const KernelBank bank(kernels);
  const PuckTracker tracker(kSensor, task.params.tracker, task.size_model, std::nullopt);
  task.region = tracker.region_around(kExpected, bank);
  const int margin = task.params.tracker.reach_margin_px;
  task.window = Region{static_cast<int>(kExpected.x) - distance.canvas_width / 2,
                       static_cast<int>(kExpected.y) - distance.canvas_height / 2,
                       distance.canvas_width + margin, distance.canvas_height + margin}
                    .intersect(task.region);
  for (unsigned seed = 1; seed <= kSurfaces; ++seed) {
    task.surfaces.push_back(surface_with_puck(task, seed));
  }
  return task;
}

class Ours {
 public:
  explicit Ours(const Task& task)
      : region_(task.region),
        bank_(task.params.kernels),
        tracker_(kSensor, task.params.tracker, task.size_model, std::nullopt) {}

  Pixel step(const SurfaceSnapshot& surface) {
    return tracker_.step(surface, region_, kExpected, bank_).position;
  }

 private:
  Region region_;
  KernelBank bank_;
  PuckTracker tracker_;
};

class TextbookStep {
 public:
  explicit TextbookStep(const Task& task) : region_(task.region), window_(task.window) {
    const KernelBank bank(task.params.kernels);
    const EllipseKernel& kernel = bank.nearest(task.size_model.at(kExpected));
    const Image<double> weights = test::weights_of(kernel);
    cv::Mat(weights.height(), weights.width(), CV_64F, const_cast<double*>(weights.row(0)))
        .convertTo(kernel_, CV_32F);
    anchor_ = {kernel.anchor_x(), kernel.anchor_y()};
    const double sigma = task.params.tracker.prior_sigma;
    const cv::Mat columns =
        gaussian(window_.x - window_.centre().x, window_.width, sigma * kernel.width());
    const cv::Mat rows =
        gaussian(window_.y - window_.centre().y, window_.height, sigma * kernel.height());
    gaussian_ = rows * columns.t();
  }

  Pixel step(const SurfaceSnapshot& surface) {
    const cv::Mat grey(surface.grey.height(), surface.grey.width(), CV_8U,
                       const_cast<std::uint8_t*>(surface.grey.row(0)));
    cv::GaussianBlur(grey, blurred_, cv::Size(5, 5), 0);
    // Large kernels by discrete Fourier transforms, as long as the picture is no part of another.
    cv::filter2D(blurred_, response_, CV_32F, kernel_, anchor_, 0, cv::BORDER_CONSTANT);
    double lowest = 0;
    cv::minMaxLoc(response_, &lowest);
    const cv::Rect window(window_.x - region_.x, window_.y - region_.y, window_.width,
                          window_.height);
    cv::subtract(response_(window), cv::Scalar(lowest), weighted_);
    cv::multiply(weighted_, gaussian_, weighted_);
    cv::Point peak;
    cv::minMaxLoc(weighted_, nullptr, nullptr, nullptr, &peak);
    return {static_cast<double>(window_.x + peak.x), static_cast<double>(window_.y + peak.y)};
  }

 private:
  static cv::Mat gaussian(double first, int count, double sigma) {
    cv::Mat values(count, 1, CV_32F);
    for (int i = 0; i < count; ++i) {
      values.at<float>(i) =
          static_cast<float>(std::exp(-0.5 * (first + i) * (first + i) / (sigma * sigma)));
    }
    return values;
  }

  Region region_;
  Region window_;
  cv::Mat kernel_;
  cv::Point anchor_;
  cv::Mat gaussian_;
  cv::Mat blurred_;
  cv::Mat response_;
  cv::Mat weighted_;
};

bool find_the_same(const Task& task) {
  Ours ours(task);
  TextbookStep textbook(task);
  for (const SurfaceSnapshot& surface : task.surfaces) {
    if (!(ours.step(surface) == textbook.step(surface))) return false;
  }
  return true;
}

template <typename Form>
void measure(benchmark::State& state, const Distance& distance) {
  const Task task = task_at(distance);
  if (!find_the_same(task)) {
    state.SkipWithError("the two forms find different places");
    return;
  }
  Form form(task);
  for (auto _ : state) {
    for (const SurfaceSnapshot& surface : task.surfaces) {
      benchmark::DoNotOptimize(form.step(surface));
    }
  }
  state.counters["steps"] = kSurfaces;
}

[[maybe_unused]] const bool registered = [] {
  for (const Distance& distance : kDistances) {
    const std::string figure = std::string("step_") + distance.name;
    benchmark::RegisterBenchmark((figure + "/ours").c_str(), measure<Ours>, distance);
    benchmark::RegisterBenchmark((figure + "/opencv").c_str(), measure<TextbookStep>, distance);
  }
  return true;
}();

}  // namespace
}  // namespace puck
