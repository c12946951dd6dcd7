#include "common/vision/contour/contour_calibration.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

TEST_CASE("events lie behind the contour by lag times speed plus a constant trail") {
  const ContourCalibration calibration{.lag_us = 500, .trail_px = 0.1};
  CHECK(calibration.behind_px(2000) == doctest::Approx(1.1));
  CHECK(calibration.behind_px(-2000) == doctest::Approx(-1.1));
  CHECK(calibration.behind_px(0) == 0);
  // A slow contour's direction is uncertain, so the trail fades in.
  CHECK(calibration.behind_px(20) == doctest::Approx(0.06));
}

}  // namespace
}  // namespace puck
