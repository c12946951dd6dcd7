#include "common/simulation/row_blend.h"

#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "common/simulation/camera_view.h"
#include "common/simulation/projected_shape.h"
#include "tests/simulation/test_worlds.h"

namespace puck {

TEST_CASE("Each of several nested shapes shows its cover beyond the one before it") {
  const SimulationParams params = small_world();
  const CameraView view(params.camera, params.sensor_size);
  const std::array<double, 3> tones{0.2, 0.7, 0.4};
  constexpr double kGround = 0.6;
  // So narrow that the edges of all three share pixels.
  std::vector<ProjectedCylinder> discs;
  SceneBody body;
  for (std::size_t i = 0; i < tones.size(); ++i) {
    const double radius_m = 0.03 + 0.001 * static_cast<double>(i);
    discs.emplace_back(view, TablePoint{0.5, 0}, radius_m, 0.01, 0.01);
    body.shapes.push_back({discs[i], static_cast<float>(tones[i]), i > 0});
  }
  RowBlend blend(params.sensor_size.width);
  int with_all_edges = 0;
  for (int y = 0; y < params.sensor_size.height; ++y) {
    blend.start(y, {0, params.sensor_size.width});
    blend.add(body);
    for (int x = 0; x < params.sensor_size.width; ++x) {
      double expected = 0;
      double before = 0;
      bool is_edge = true;
      for (std::size_t i = 0; i < tones.size(); ++i) {
        float share = 0;
        discs[i].coverage(y, x, 1, &share);
        is_edge &= share > 0.05f && share < 0.95f;
        expected += (share - before) * tones[i];
        before = share;
      }
      expected += (1 - before) * kGround;
      with_all_edges += is_edge ? 1 : 0;
      const double light = std::exp(blend.log_light_over(x, std::log(static_cast<float>(kGround))));
      REQUIRE(light == doctest::Approx(expected).epsilon(0.002));
    }
  }
  CHECK(with_all_edges > 5);
}

}  // namespace puck
