#include "common/vision/correlation/plain_sums.h"

namespace puck {

void sum_plainly(const RowSums& picture, const EllipseKernel& kernel, const Region& candidates,
                 std::array<KernelSweep::Totals, 3>& sums) {
  for (KernelSweep::Totals& totals : sums) totals.make_room(candidates, candidates);
  const int left = candidates.x - kernel.anchor_x() - picture.place().x;
  const int top = candidates.y - kernel.anchor_y() - picture.place().y;
  for (int y = 0; y < candidates.height; ++y) {
    for (int x = 0; x < candidates.width; ++x) {
      std::array<std::int32_t, 3> at{};
      for (int row = 0; row < kernel.height(); ++row) {
        const std::uint8_t* pixels = picture.picture().row(top + y + row) + left + x;
        const auto add = [&](std::size_t shape, int first, int last) {
          for (int column = first; column < last; ++column) at[shape] += pixels[column];
        };
        add(0, 0, kernel.width());
        add(1, kernel.outer_run(row).first, kernel.outer_run(row).last);
        add(2, kernel.inner_run(row).first, kernel.inner_run(row).last);
      }
      for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i].values[static_cast<std::size_t>(y * sums[i].stride + x)] = at[i];
      }
    }
  }
}

}  // namespace puck
