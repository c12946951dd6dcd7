#include "common/simulation/panorama.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr int kSamples = 4;     // Samples along each side of a pixel at an edge.
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

  // Single points are exact where the scene is flat; where neighbours differ, the pixel's area is
  // averaged.
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
      // One more node on the right and below, so that an edge between two cells is found.
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

// A turned camera reads some hundred thousand pixels a ms. The loops have no branches, so that the
// compiler vectorises them.
void Panorama::along(float x, float y, float step_x, float step_y,
                     std::array<float, kRun>& light) const {
  const float scale = static_cast<float>(nodes_per_px_);
  const float from_x = (x + static_cast<float>(margin_.x_px)) * scale;
  const float from_y = (y + static_cast<float>(margin_.y_px)) * scale;
  const float last_x = static_cast<float>(nodes_.width() - 2);
  const float last_y = static_cast<float>(nodes_.height() - 2);
  std::array<float, kRun> share_x, share_y;
  std::array<int, kRun> place;
  for (int i = 0; i < kRun; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const float steps = static_cast<float>(i) * scale;
    const float node_x = std::min(std::max(from_x + steps * step_x, 0.0f), last_x);
    const float node_y = std::min(std::max(from_y + steps * step_y, 0.0f), last_y);
    const int left = static_cast<int>(node_x);
    const int top = static_cast<int>(node_y);
    share_x[at] = node_x - static_cast<float>(left);
    share_y[at] = node_y - static_cast<float>(top);
    place[at] = top * nodes_.width() + left;
  }
  const float* nodes = nodes_.row(0);
  const float* below_nodes = nodes_.row(1);
  std::array<float, kRun> a, b, c, d;
  for (std::size_t i = 0; i < kRun; ++i) {
    a[i] = nodes[place[i]];
    b[i] = nodes[place[i] + 1];
    c[i] = below_nodes[place[i]];
    d[i] = below_nodes[place[i] + 1];
  }
  for (std::size_t i = 0; i < kRun; ++i) {
    const float above = a[i] + share_x[i] * (b[i] - a[i]);
    const float below = c[i] + share_x[i] * (d[i] - c[i]);
    light[i] = above + share_y[i] * (below - above);
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
