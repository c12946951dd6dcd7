// The tracking step beside its plain form in the authors' code, with OpenCV: blur, filter2D in
// single precision, the Gaussian, the maximum. Our sums are exact and OpenCV's rounded: where the
// two best places are almost equal, the rounding may choose the other one.
#include <cmath>
#include <random>

#include <doctest/doctest.h>
#include <opencv2/imgproc.hpp>

#include "common/io/event_reader.h"
#include "common/vision/paper/paper_presets.h"
#include "common/vision/paper/puck_tracker.h"
#include "common/vision/surface/surface.h"
#include "tests/support/kernel_weights.h"
#include "tests/support/recordings.h"
#include "tests/support/sanitizers.h"

namespace puck {
namespace {

constexpr PuckSize kSizes[] = {{15, 7}, {37, 27}, {51, 45}};

struct Agreement {
  int same = 0;
  int all = 0;
};

PuckPipelineParams reference_of_one_maximum() {
  PuckPipelineParams params = reference_params();
  params.tracker.quantised = false;
  params.kernels.smallest_px = 7;
  params.kernels.size_scale = 1;
  return params;
}

void compare_at(Surface& surface, Pixel expected, PuckSize size, Agreement& agreement) {
  const PuckPipelineParams params = reference_of_one_maximum();
  PuckSizeModel model;
  model.width_0 = size.width;
  model.height_0 = size.height;
  const KernelBank bank(params.kernels);
  PuckTracker tracker(surface.size(), params.tracker, model, std::nullopt);
  const Region region = tracker.region_around(expected, bank);
  SurfaceSnapshot snapshot;
  surface.snapshot(region, snapshot);
  const Pixel ours = tracker.step(snapshot, region, expected, bank).position;

  const EllipseKernel& kernel = bank.nearest(size);
  const Region window = Region{static_cast<int>(expected.x) - kernel.width() / 2,
                               static_cast<int>(expected.y) - kernel.height() / 2,
                               kernel.width() + params.tracker.reach_margin_px,
                               kernel.height() + params.tracker.reach_margin_px}
                            .intersect(region);
  const cv::Mat grey(snapshot.grey.height(), snapshot.grey.width(), CV_8U, snapshot.grey.row(0));
  cv::Mat blurred;
  cv::GaussianBlur(grey, blurred, cv::Size(5, 5), 0);
  Image<double> weights = test::weights_of(kernel);
  cv::Mat filter;
  cv::Mat(weights.height(), weights.width(), CV_64F, weights.row(0)).convertTo(filter, CV_32F);
  cv::Mat response;
  cv::filter2D(blurred, response, CV_32F, filter, {kernel.anchor_x(), kernel.anchor_y()}, 0,
               cv::BORDER_CONSTANT);
  double lowest = 0;
  cv::minMaxLoc(response, &lowest);
  double best = 0;
  Pixel theirs = expected;
  for (int y = window.y; y < window.bottom(); ++y) {
    for (int x = window.x; x < window.right(); ++x) {
      const double u = (x - window.centre().x) / (params.tracker.prior_sigma * kernel.width());
      const double v = (y - window.centre().y) / (params.tracker.prior_sigma * kernel.height());
      const double value = (response.at<float>(y - region.y, x - region.x) - lowest) *
                           std::exp(-0.5 * (u * u + v * v));
      if (value > best) {
        best = value;
        theirs = {static_cast<double>(x), static_cast<double>(y)};
      }
    }
  }
  ++agreement.all;
  if (ours == theirs) ++agreement.same;
}

}  // namespace

TEST_CASE("the step finds OpenCV's maximum on random surfaces, except for a rare near tie") {
  constexpr int kRounds = kIsSanitized ? 16 : 60;
  std::mt19937 random(8);
  Agreement agreement;
  for (int round = 0; round < kRounds; ++round) {
    Surface surface({240, 200}, reference_params().eros);
    for (int i = 0; i < 200 << (round % 8); ++i) {
      surface.update(Event{static_cast<std::uint16_t>(random() % 240),
                           static_cast<std::uint16_t>(random() % 200), 1, 0});
    }
    for (const PuckSize size : kSizes) compare_at(surface, {120, 100}, size, agreement);
  }
  MESSAGE("the same in " << agreement.same << " of " << agreement.all);
  CHECK(agreement.same >= agreement.all * 0.98);
}

TEST_CASE("the step finds OpenCV's maximum on surfaces of real recordings") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  constexpr int kPackets = kIsSanitized ? 6 : 20;
  Agreement agreement;
  for (const char* file : {"driving_gen41_1280x720_evt3.raw", "sparklers_gen31_640x480_evt2.raw"}) {
    const auto events = open_event_file(*recordings / file);
    Surface surface(events->sensor_size(), reference_params().eros);
    EventPacket packet;
    for (int i = 0; i < kPackets && events->read(packet, 50'000); ++i) {
      surface.update(packet);
      for (const PuckSize size : kSizes) {
        for (const Pixel place : {Pixel{200, 150}, {320, 240}, {500, 400}, {60, 470}}) {
          compare_at(surface, place, size, agreement);
        }
      }
    }
  }
  MESSAGE("the same in " << agreement.same << " of " << agreement.all);
  REQUIRE(agreement.all > 100);
  CHECK(agreement.same >= agreement.all * 0.98);
}

}  // namespace puck
