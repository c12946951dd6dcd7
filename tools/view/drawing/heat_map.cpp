#include "tools/view/drawing/heat_map.h"

#include <algorithm>

#include "common/vision/paper/paper_presets.h"

namespace puck {
namespace {

// Rows with the same kernel: the puck's size changes little from row to row.
constexpr int kBand_px = 8;

}  // namespace

HeatMap::HeatMap(const PuckSizeModel& size_model)
    : size_model_(correlation_params().sizes_of(size_model)),
      kernels_(correlation_params().kernels) {}

void HeatMap::fill(const Image<std::uint8_t>& surface, Image<std::uint8_t>& heat) {
  const Region all{0, 0, surface.width(), surface.height()};
  heat.resize(all.width, all.height);
  correlation_.set_surface(surface.view(), all);
  correlation_.cover(all);
  for (int top = 0; top < all.height; top += kBand_px) {
    const Region band = Region{0, top, all.width, kBand_px}.intersect(all);
    correlation_.correlate(kernels_.nearest(size_model_.at(band.centre())), band, map_);
    for (int y = 0; y < band.height; ++y) {
      const double* scores = map_.response.row(y);
      std::transform(scores, scores + band.width, heat.row(top + y), [](double score) {
        return static_cast<std::uint8_t>(std::clamp(score, 0.0, 1.0) * 255);
      });
    }
  }
}

}  // namespace puck
