#include "common/simulation/panorama.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr int kSamples = 4;     // Along each side of a pixel, where there is an edge.
constexpr int kCell_px = 2;     // Side of the cells that are busy or flat.
constexpr float kFlat = 1e-4f;  // Largest difference of ln(luminance) in a flat cell.

}  // namespace

Panorama::Panorama(const StaticScene& scene, const CameraView& home, SensorSize size, Margin margin,
                   int nodes_per_px)
    : margin_(margin),
      nodes_per_px_(nodes_per_px),
      nodes_((size.width + 2 * margin.x_px) * nodes_per_px + 1,
             (size.height + 2 * margin.y_px) * nodes_per_px + 1) {
  render(scene, home);
  find_busy_cells();
}

void Panorama::render(const StaticScene& scene, const CameraView& home) {
  const auto luminance = [&](double node_x, double node_y) {
    const Pixel pixel{node_x / nodes_per_px_ - margin_.x_px, node_y / nodes_per_px_ - margin_.y_px};
    return scene.luminance(home.centre(), home.ray(pixel));
  };
  const int width = nodes_.width();
  const int height = nodes_.height();
  Image<float> points(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) points(x, y) = static_cast<float>(luminance(x, y));
  }

  // Points are exact where the scene is flat; where neighbours differ, the pixel's area counts.
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      float lowest = points(x, y);
      float highest = lowest;
      for (int ny = std::max(0, y - 1); ny <= std::min(height - 1, y + 1); ++ny) {
        for (int nx = std::max(0, x - 1); nx <= std::min(width - 1, x + 1); ++nx) {
          lowest = std::min(lowest, points(nx, ny));
          highest = std::max(highest, points(nx, ny));
        }
      }
      double mean = points(x, y);
      if (lowest != highest) {
        mean = 0;
        for (int i = 0; i < kSamples * kSamples; ++i) {
          const double dx = (i % kSamples + 0.5) / kSamples - 0.5;
          const double dy = (i / kSamples + 0.5) / kSamples - 0.5;
          mean += luminance(x + dx * nodes_per_px_, y + dy * nodes_per_px_);
        }
        mean /= kSamples * kSamples;
      }
      nodes_(x, y) = static_cast<float>(std::log(mean));
    }
  }
}

void Panorama::find_busy_cells() {
  const int cell = kCell_px * nodes_per_px_;
  const int columns = (nodes_.width() + cell - 1) / cell;
  const int rows = (nodes_.height() + cell - 1) / cell;
  busy_before_.resize(columns + 1, rows + 1);
  for (int i = 0; i <= columns; ++i) busy_before_(i, 0) = 0;
  for (int row = 0; row < rows; ++row) {
    busy_before_(0, row + 1) = 0;
    for (int column = 0; column < columns; ++column) {
      // One node more on the right and below, so that no edge hides between two cells.
      const int right = std::min(nodes_.width() - 1, (column + 1) * cell);
      const int bottom = std::min(nodes_.height() - 1, (row + 1) * cell);
      float lowest = nodes_(column * cell, row * cell);
      float highest = lowest;
      for (int y = row * cell; y <= bottom; ++y) {
        for (int x = column * cell; x <= right; ++x) {
          lowest = std::min(lowest, nodes_(x, y));
          highest = std::max(highest, nodes_(x, y));
        }
      }
      busy_before_(column + 1, row + 1) = (highest - lowest > kFlat ? 1 : 0) +
                                          busy_before_(column, row + 1) +
                                          busy_before_(column + 1, row) - busy_before_(column, row);
    }
  }
}

bool Panorama::is_busy(float left, float top, float right, float bottom) const {
  const float cell = static_cast<float>(kCell_px);
  const int columns = busy_before_.width() - 1;
  const int rows = busy_before_.height() - 1;
  const auto column_of = [&](float x) {
    const float cells = std::floor((x + static_cast<float>(margin_.x_px)) / cell);
    return static_cast<int>(std::clamp(cells, 0.0f, static_cast<float>(columns - 1)));
  };
  const auto row_of = [&](float y) {
    const float cells = std::floor((y + static_cast<float>(margin_.y_px)) / cell);
    return static_cast<int>(std::clamp(cells, 0.0f, static_cast<float>(rows - 1)));
  };
  const int x0 = column_of(left), x1 = column_of(right) + 1;
  const int y0 = row_of(top), y1 = row_of(bottom) + 1;
  return busy_before_(x1, y1) - busy_before_(x0, y1) - busy_before_(x1, y0) + busy_before_(x0, y0) >
         0;
}

}  // namespace puck
