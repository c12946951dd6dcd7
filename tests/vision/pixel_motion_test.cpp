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

}  // namespace puck
