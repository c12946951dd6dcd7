#include "common/vision/edge_trail.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

EdgeTrailParams enabled() {
  EdgeTrailParams params;
  params.enabled = true;
  return params;
}

EdgeTrail after(const EdgeTrailParams& params, double spread_px, double speed_px_s, int steps) {
  EdgeTrail trail(params);
  for (int i = 1; i <= steps; ++i) trail.learn(spread_px, speed_px_s, {i * 1000});
  return trail;
}

}  // namespace

TEST_CASE("a sharp ring has no trail, a wide one a long one") {
  CHECK(after(enabled(), 0.6, 300, 2000).length() == 0);
  CHECK(after(enabled(), 1.4, 300, 2000).length() > 0.99);
  CHECK(after(enabled(), 1.05 + 170e-6 * 300, 300, 2000).length() ==
        doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("what is wide only because it is fast has no trail") {
  CHECK(after(enabled(), 1.3, 3500, 2000).length() == 0);
}

TEST_CASE("a trail is learned over its time, however long the pause before") {
  CHECK(after(enabled(), 1.4, 300, 20).length() == doctest::Approx(0.1).epsilon(0.1));
  EdgeTrail paused(enabled());
  paused.learn(1.4, 300, {60'000'000});
  CHECK(paused.length() == doctest::Approx(0.05));
}

TEST_CASE("a switched-off trail is that of a dark puck") {
  CHECK(after({}, 1.4, 300, 2000).length() == 0);
}

}  // namespace puck
