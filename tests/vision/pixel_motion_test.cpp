#include "common/vision/paper/pixel_motion.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr std::int64_t kStepUs = 1000;

// A puck in uniform motion from (100, 200), measured `steps` times.
PixelMotion even_motion(const PixelMotionParams& params, PixelVelocity velocity, int steps) {
  PixelMotion motion(params);
  motion.start({100, 200}, {0});
  for (int i = 1; i <= steps; ++i) {
    const double t = i * 1e-3;
    motion.measure({100 + velocity.x * t, 200 + velocity.y * t}, {i * kStepUs});
  }
  return motion;
}

}  // namespace

TEST_CASE("a uniform motion is learned and predicted") {
  const PixelMotion motion = even_motion({}, {1000, -500}, 200);
  CHECK(motion.velocity().x == doctest::Approx(1000).epsilon(0.01));
  CHECK(motion.velocity().y == doctest::Approx(-500).epsilon(0.01));
  const Pixel expected = motion.expected_at({210 * kStepUs});
  CHECK(expected.x == doctest::Approx(310).epsilon(0.001));
  CHECK(expected.y == doctest::Approx(95).epsilon(0.001));
}

TEST_CASE("a measurement with a smaller variance counts more, on its own axis") {
  PixelMotion motion({});
  motion.start({100, 200}, {0});
  motion.measure({102, 202}, {kStepUs}, PixelVariance{0.01, 4});
  CHECK(motion.position().x > 101.9);
  CHECK(motion.position().y < 201.5);
  CHECK(motion.covariance()[0] < 0.01);
  CHECK(motion.covariance()[5] > 0.3);
}

TEST_CASE("after a detected bounce the velocity is right within a few steps") {
  const auto after_bounce = [](double surprise_sigmas) {
    PixelMotionParams params;
    params.measurement_sigma_px = 0.2;
    params.surprise_sigmas = surprise_sigmas;
    PixelMotion motion = even_motion(params, {3000, 0}, 100);
    for (int i = 1; i <= 5; ++i) motion.measure({400 - 3.0 * i, 200}, {(100 + i) * kStepUs});
    return motion;
  };
  CHECK(after_bounce(6).position().x == doctest::Approx(385).epsilon(0.001));
  CHECK(after_bounce(6).velocity().x == doctest::Approx(-3000).epsilon(0.05));
  CHECK(after_bounce(0).position().x > 386);
}

TEST_CASE("a deviation as likely as noise is no surprise") {
  PixelMotionParams params;
  params.measurement_sigma_px = 0.2;
  PixelMotionParams watchful = params;
  watchful.surprise_sigmas = 6;
  PixelMotion plain = even_motion(params, {300, 0}, 100);
  PixelMotion with_surprises = even_motion(watchful, {300, 0}, 100);
  plain.measure({130.3 + 0.4, 200}, {101 * kStepUs});
  with_surprises.measure({130.3 + 0.4, 200}, {101 * kStepUs});
  CHECK(with_surprises.position() == plain.position());
  CHECK(with_surprises.covariance() == plain.covariance());
}

}  // namespace puck
