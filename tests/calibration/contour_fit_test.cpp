#include "common/calibration/contour_fit.h"

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/calibration/truth_motion.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{640, 480};
constexpr PuckSizeModel kSize{40, 0, 0, 28, 0, 0};

// A puck on a circle, optionally with growing speed, and the events of its contour by a known
// calibration.
struct Circling {
  double speed_px_s = 1500;
  double faster_px_s2 = 0;
  double seconds = 1;
  double events_per_ms = 30;
  ContourCalibration calibration{400, 0, 0.5};
  double beside_per_ms = 0;  // Events 5 px outside the contour.
  // Share of the events that a print makes, 2 px inside the contour and of the other sign.
  double print_share = 0;
  bool has_signs = true;

  static constexpr double kRadius = 100;

  double angle_at(double t_s) const {
    return (speed_px_s + faster_px_s2 * t_s / 2) * t_s / kRadius;
  }
  Pixel centre_at(double t_s) const {
    const double angle = angle_at(t_s);
    return {320 + kRadius * std::cos(angle), 240 + kRadius * std::sin(angle)};
  }

  std::vector<TruthRow> truth() const {
    std::vector<TruthRow> rows;
    for (int ms = 0; ms <= 1000 * seconds; ++ms) {
      rows.push_back({{1000 * ms}, centre_at(1e-3 * ms), {40, 28}, 1});
    }
    return rows;
  }

  EventPacket events() const {
    EventPacket packet;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
    std::uniform_real_distribution<double> share(0, 1);
    std::normal_distribution<double> noise(0, 0.4);
    const double a = (40 + calibration.grow_px) / 2;
    const double wall = calibration.wall_share * 2 * a;
    const double b = (28 + calibration.grow_px - wall) / 2;
    const double step_us = 1000 / (events_per_ms + beside_per_ms);
    for (double t_us = 0; t_us < 1e6 * seconds; t_us += step_us) {
      const Pixel c = centre_at((t_us - calibration.lag_us) * 1e-6);
      const double heading = angle_at(t_us * 1e-6) + std::numbers::pi / 2;
      const double beside = share(random) < beside_per_ms / (events_per_ms + beside_per_ms) ? 5 : 0;
      // The rate of an edge's events is proportional to the area that it sweeps.
      double angle = turn(random);
      double nx = 0;
      double ny = 0;
      double along = 0;
      do {
        angle = turn(random);
        nx = std::cos(angle) / a;
        ny = std::sin(angle) / b;
        const double length = std::hypot(nx, ny);
        nx /= length;
        ny /= length;
        along = nx * std::cos(heading) + ny * std::sin(heading);
      } while (share(random) > std::abs(along));
      const bool is_print = print_share > 0 && share(random) < print_share;
      const double out =
          beside - (is_print ? 2 : 0) + noise(random) - std::copysign(calibration.trail_px, along);
      Event event;
      event.x = static_cast<std::uint16_t>(std::lround(c.x + a * std::cos(angle) + nx * out));
      event.y =
          static_cast<std::uint16_t>(std::lround(c.y - wall / 2 + b * std::sin(angle) + ny * out)) &
          0x7fff;
      event.polarity = has_signs && (along < 0) != is_print ? 1 : 0;
      event.offset_us = static_cast<std::uint32_t>(t_us);
      packet.events.push_back(event);
    }
    return packet;
  }
};

ContourFit fit_of(const Circling& scene, const PuckSizeModel& size = kSize) {
  const TruthMotion truth(scene.truth());
  ContourSamples samples(truth, kSensor, size);
  samples.add(scene.events());
  samples.finish();
  return fit_contour(samples);
}

TEST_CASE("the fit recovers the lag, the wall's share and the growth behind the events") {
  Circling scene;
  scene.calibration = {620, 0.15, -0.4};
  const ContourFit fit = fit_of(scene);
  CHECK(std::abs(fit.calibration.lag_us - 620) < 20);
  CHECK(std::abs(fit.calibration.wall_share - 0.15) < 0.005);
  CHECK(std::abs(fit.calibration.grow_px + 0.4) < 0.08);
  CHECK(fit.spread_px < 0.6);
  CHECK(fit.spread_before_px > 1.2 * fit.spread_px);
  CHECK(std::abs(fit.front_px) < 0.05);
  CHECK(std::abs(fit.lower_px) < 0.1);
  CHECK(fit.events > 20'000);
}

TEST_CASE("a print within the contour is excluded by its sign, if events have signs") {
  Circling scene;
  scene.print_share = 0.25;
  const ContourFit fit = fit_of(scene);
  CHECK(fit.calibration.lag_us == doctest::Approx(400).epsilon(0.05));
  CHECK(std::abs(fit.calibration.grow_px - 0.5) < 0.15);
  scene.has_signs = false;
  CHECK(fit_of(scene).calibration.grow_px < 0.2);
}

TEST_CASE("lag in time and trail in space are separated if the speed varies") {
  Circling scene;
  scene.speed_px_s = 300;
  scene.faster_px_s2 = 3000;
  scene.calibration = {350, 0, 0.3, 0.25};
  const ContourFit fit = fit_of(scene);
  CHECK(std::abs(fit.calibration.lag_us - 350) < 25);
  CHECK(std::abs(fit.calibration.trail_px - 0.25) < 0.03);
  CHECK(std::abs(fit.calibration.lag_us - 350) < 4 * fit.standard_error.lag_us);
}

TEST_CASE("a sensor without lag and a contour as annotated are recovered, too") {
  Circling scene;
  scene.calibration = {0, 0, 0};
  const ContourFit fit = fit_of(scene);
  CHECK(std::abs(fit.calibration.lag_us) < 20);
  CHECK(std::abs(fit.calibration.wall_share) < 0.005);
  CHECK(std::abs(fit.calibration.grow_px) < 0.08);
}

TEST_CASE("the standard errors cover the fit's error, and shrink with more events") {
  Circling few;
  few.events_per_ms = 4;
  const ContourFit rough = fit_of(few);
  const ContourFit fine = fit_of(Circling{});
  CHECK(std::abs(rough.calibration.lag_us - 400) < 4 * rough.standard_error.lag_us);
  CHECK(std::abs(fine.calibration.lag_us - 400) < 4 * fine.standard_error.lag_us + 5);
  CHECK(fine.standard_error.lag_us < 0.7 * rough.standard_error.lag_us);
  CHECK(fine.standard_error.lag_us > 0.5);
}

TEST_CASE("times with other events beside the puck are left out") {
  Circling scene;
  scene.beside_per_ms = 15;
  const TruthMotion truth(scene.truth());
  ContourSamples samples(truth, kSensor, kSize);
  samples.add(scene.events());
  samples.finish();
  CHECK(samples.windows() > 450);
  CHECK(samples.clear_windows() < samples.windows() / 20);
}

TEST_CASE("truth is not interpolated across a bounce, a gap or an occlusion") {
  std::vector<TruthRow> rows;
  for (int ms = 0; ms <= 100; ++ms) {
    const double x = ms < 50 ? 100 + 2.0 * ms : 200 - 2.0 * (ms - 50);
    rows.push_back({{1000 * ms}, {x, 200}, {40, 28}, ms >= 80 && ms < 85 ? 0.5 : 1.0});
  }
  const TruthMotion truth(rows);
  const auto before = truth.at({20'500});
  REQUIRE(before.has_value());
  CHECK(before->position.x == doctest::Approx(141));
  CHECK(before->velocity.x == doctest::Approx(2000));
  CHECK(before->velocity.y == doctest::Approx(0));
  CHECK_FALSE(truth.at({51'500}).has_value());
  CHECK_FALSE(truth.at({56'000}).has_value());
  CHECK(truth.at({65'000})->velocity.x == doctest::Approx(-2000));
  CHECK_FALSE(truth.at({82'000}).has_value());
  CHECK_FALSE(truth.at({-1'000}).has_value());
  CHECK_FALSE(truth.at({101'000}).has_value());
}

TEST_CASE("too few events and a puck too slow for the lag are refused with the reason") {
  Circling few;
  few.events_per_ms = 0.8;
  CHECK_THROWS_AS(fit_of(few), std::invalid_argument);
  Circling slow;
  slow.speed_px_s = 70;
  slow.events_per_ms = 5;
  try {
    fit_of(slow);
    FAIL("accepted");
  } catch (const std::invalid_argument& error) {
    CHECK(std::string(error.what()).find("too slow to determine the lag") != std::string::npos);
  }
}

}  // namespace
}  // namespace puck
