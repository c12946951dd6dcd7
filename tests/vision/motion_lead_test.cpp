#include "common/vision/motion_lead.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

// Both axes alike: px², px²/s, px²/s².
constexpr std::array<double, 16> kCovariance{0.04, 0, 2, 0,   0, 0.04, 0, 2,
                                             2,    0, 900, 0, 0, 2,    0, 900};

MotionLeadParams lead() {
  MotionLeadParams params;
  params.enabled = true;
  params.edge_px = 0.25;
  params.slow_px_s = 300;
  params.edge_us = 100;
  params.trail_gain = 2;
  params.edge_sigma_px = 0;
  params.lag_sigma_us = 0;
  params.trail_sigma_px = 0;
  return params;
}

}  // namespace

TEST_CASE("a position is moved forward by the lags' time and by the edge's width") {
  // 500 px/s: with the slow speed beside it, 400 and 300, the edge's share is 400 / 500.
  const LedPosition led = lead_forward({100, 50}, {400, 0}, kCovariance, 300, 0, lead());
  CHECK(led.position.x == doctest::Approx(100 + 400 * 400e-6 + 0.25 * 0.8));
  CHECK(led.position.y == 50);
}

TEST_CASE("a puck at rest stays where it is, and a switched-off lead moves nothing") {
  CHECK(lead_forward({100, 50}, {0, 0}, kCovariance, 300, 1, lead()).position == Pixel{100, 50});
  const LedPosition off = lead_forward({100, 50}, {400, 0}, kCovariance, 300, 0, {});
  CHECK(off.position == Pixel{100, 50});
  CHECK(off.covariance == kCovariance);
}

TEST_CASE("a long trail leads farther, by the edge's part alone") {
  const LedPosition led = lead_forward({100, 50}, {400, 0}, kCovariance, 300, 1, lead());
  CHECK(led.position.x == doctest::Approx(100 + 400 * (300e-6 + 3 * 100e-6) + 3 * 0.25 * 0.8));
}

TEST_CASE("the unknown velocity makes the led position less certain") {
  MotionLeadParams params = lead();
  params.edge_px = 0;
  // 1 ms in all.
  const LedPosition led = lead_forward({100, 50}, {400, 0}, kCovariance, 900, 0, params);
  CHECK(led.covariance[0] == doctest::Approx(0.04 + 2 * 1e-3 * 2 + 1e-6 * 900));
  CHECK(led.covariance[2] == doctest::Approx(2 + 1e-3 * 900));
  CHECK(led.covariance[8] == led.covariance[2]);
  CHECK(led.covariance[10] == 900);
  CHECK(led.covariance[1] == 0);
}

TEST_CASE("unknown lags count along the motion only, an unknown trail in every direction") {
  MotionLeadParams params = lead();
  params.lag_sigma_us = 100;
  const LedPosition known = lead_forward({100, 50}, {600, 800}, kCovariance, 300, 0, lead());
  const LedPosition lags = lead_forward({100, 50}, {600, 800}, kCovariance, 300, 0, params);
  CHECK(lags.covariance[0] - known.covariance[0] == doctest::Approx(0.06 * 0.06));
  CHECK(lags.covariance[5] - known.covariance[5] == doctest::Approx(0.08 * 0.08));
  CHECK(lags.covariance[1] == doctest::Approx(0.06 * 0.08));
  CHECK(lags.covariance[4] == lags.covariance[1]);

  params = lead();
  params.trail_sigma_px = 0.5;
  const LedPosition trail = lead_forward({100, 50}, {0, 0}, kCovariance, 0, 1, params);
  const LedPosition without = lead_forward({100, 50}, {0, 0}, kCovariance, 0, 0, params);
  CHECK(trail.covariance[0] - without.covariance[0] > 0.25);
  CHECK(trail.covariance[5] == doctest::Approx(trail.covariance[0]));
}

}  // namespace puck
