#include "common/simulation/scene_renderer.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr int kBlock_px = Panorama::kRun;
// A turned camera samples the panorama between its points; a finer grid keeps edges sharp.
constexpr int kNodesPerPixelTurned = 2;

struct Place {
  float x = 0;
  float y = 0;
};

Place warped(const std::array<float, 9>& warp, float x, float y) {
  const float per_depth = 1 / (warp[6] * x + warp[7] * y + warp[8]);
  return {(warp[0] * x + warp[1] * y + warp[2]) * per_depth,
          (warp[3] * x + warp[4] * y + warp[5]) * per_depth};
}

std::array<float, 9> warp_between(const CameraView& home, const CameraView& view) {
  const Vector3 first = view.ray({0, 0});
  const Vector3 step_x = view.ray({1, 0}) - first;
  const Vector3 step_y = view.ray({0, 1}) - first;
  const auto row = [&](const Vector3& axis, double offset_px) {
    const Vector3 scaled = home.focal_px() * axis + offset_px * home.forward();
    return std::array<double, 3>{dot(step_x, scaled), dot(step_y, scaled), dot(first, scaled)};
  };
  const auto u = row(home.right(), home.principal_point().x);
  const auto v = row(home.down(), home.principal_point().y);
  const Vector3 forward = home.forward();
  const std::array<double, 9> warp{u[0],
                                   u[1],
                                   u[2],
                                   v[0],
                                   v[1],
                                   v[2],
                                   dot(step_x, forward),
                                   dot(step_y, forward),
                                   dot(first, forward)};
  std::array<float, 9> narrow{};
  for (std::size_t i = 0; i < warp.size(); ++i) narrow[i] = static_cast<float>(warp[i]);
  return narrow;
}

}  // namespace

SceneRenderer::SceneRenderer(const StaticScene& scene, const CameraView& home, SensorSize size,
                             Panorama::Margin margin)
    : home_(home),
      size_(size),
      panorama_(scene, home, size, margin,
                margin.x_px > 0 || margin.y_px > 0 ? kNodesPerPixelTurned : 1),
      background_(size.width, size.height),
      reserved_(size.width, size.height),
      to_draw_(static_cast<std::size_t>(size.height)),
      blend_(size.width) {
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      background_(x, y) = panorama_.at(static_cast<float>(x), static_cast<float>(y));
    }
  }
  const int columns = (size.width + kBlock_px - 1) / kBlock_px;
  const int rows = (size.height + kBlock_px - 1) / kBlock_px;
  was_busy_.assign(static_cast<std::size_t>(columns * rows), true);
}

void SceneRenderer::turn_camera(const CameraView& view, int reach_px, Timestamp from, Timestamp to,
                                EventSensor& sensor) {
  std::fill_n(reserved_.row(0), size_.width * size_.height, std::uint8_t{0});
  for (const SceneBody& body : drawn_) reserve_around(body, reach_px);
  const Warp warp = warp_between(home_, view);
  std::size_t index = 0;
  for (int y = 0; y < size_.height; y += kBlock_px) {
    for (int x = 0; x < size_.width; x += kBlock_px, ++index) {
      const Region block = Region{x, y, kBlock_px, kBlock_px}.intersect(Region::all_of(size_));
      const bool busy = is_busy(block, warp);
      // A block that has just become flat is drawn once more, with its final tone.
      if (busy || was_busy_[index]) draw_block(block, warp, from, to, sensor);
      was_busy_[index] = busy;
    }
  }
}

bool SceneRenderer::is_busy(const Region& block, const Warp& warp) const {
  constexpr float kAround_px = 1;
  const float left = static_cast<float>(block.x), right = static_cast<float>(block.right() - 1);
  const float top = static_cast<float>(block.y), bottom = static_cast<float>(block.bottom() - 1);
  const std::array<Place, 4> corners{warped(warp, left, top), warped(warp, right, top),
                                     warped(warp, left, bottom), warped(warp, right, bottom)};
  Place low = corners[0], high = corners[0];
  for (const Place& corner : corners) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  return panorama_.is_busy(low.x - kAround_px, low.y - kAround_px, high.x + kAround_px,
                           high.y + kAround_px);
}

void SceneRenderer::draw_block(const Region& block, const Warp& warp, Timestamp from, Timestamp to,
                               EventSensor& sensor) {
  // Over a few pixels the warp of a rotation is linear to good accuracy.
  const float per_step = 1 / static_cast<float>(std::max(1, block.width - 1));
  for (int y = block.y; y < block.bottom(); ++y) {
    const float row = static_cast<float>(y);
    const Place first = warped(warp, static_cast<float>(block.x), row);
    const Place last = warped(warp, static_cast<float>(block.right() - 1), row);
    const Place step{(last.x - first.x) * per_step, (last.y - first.y) * per_step};
    std::array<float, Panorama::kRun> light;
    panorama_.along(first.x, first.y, step.x, step.y, light);
    const std::uint8_t* reserved = reserved_.row(y) + block.x;
    float* background = background_.row(y) + block.x;
    const float* drawn = sensor.log_intensities(y) + block.x;
    int changes = 0;
    for (int i = 0; i < block.width; ++i) {
      const float now = light[static_cast<std::size_t>(i)];
      background[i] = now;
      changes += EventSensor::is_change(drawn[i], now) ? 1 : 0;
    }
    if (changes == 0) continue;
    for (int i = 0; i < block.width; ++i) {
      if (reserved[i] != 0) continue;
      sensor.change(block.x + i, y, light[static_cast<std::size_t>(i)], from, to);
    }
  }
}

void SceneRenderer::reserve_around(const SceneBody& body, int reach_px) {
  for (const SceneShape& shape : body.shapes) {
    const ConvexOutline& outline = shape.outline();
    const int first = std::max(0, outline.first_row() - reach_px);
    const int end = std::min(size_.height, outline.end_row() + reach_px);
    for (int y = first; y < end; ++y) {
      Columns around{size_.width, 0};
      for (int near = y - reach_px; near <= y + reach_px; ++near) {
        const Columns columns = outline.touched(near);
        if (columns.empty()) continue;
        around = {std::min(around.begin, columns.begin - reach_px),
                  std::max(around.end, columns.end + reach_px)};
      }
      around = {std::max(0, around.begin), std::min(size_.width, around.end)};
      if (around.empty()) continue;
      std::fill(reserved_.row(y) + around.begin, reserved_.row(y) + around.end, std::uint8_t{1});
      mark(y, around);
    }
  }
}

void SceneRenderer::mark(int y, Columns columns) {
  columns = {std::max(0, columns.begin), std::min(size_.width, columns.end)};
  if (!columns.empty()) to_draw_[static_cast<std::size_t>(y)].push_back(columns);
}

// Only the pixels between the outer edge of one silhouette and the inner edge of the other can have
// changed, on the left and on the right.
void SceneRenderer::mark_changes(const SceneBody& before, const SceneBody& now, bool everything) {
  const std::size_t count = std::max(before.shapes.size(), now.shapes.size());
  for (std::size_t i = 0; i < count; ++i) {
    const ConvexOutline* old_outline =
        i < before.shapes.size() ? &before.shapes[i].outline() : nullptr;
    const ConvexOutline* new_outline = i < now.shapes.size() ? &now.shapes[i].outline() : nullptr;
    const ConvexOutline& either = old_outline != nullptr ? *old_outline : *new_outline;
    int first = either.first_row();
    int end = either.end_row();
    if (new_outline != nullptr) {
      first = std::min(first, new_outline->first_row());
      end = std::max(end, new_outline->end_row());
    }
    for (int y = first; y < end; ++y) {
      const Columns old_touched = old_outline != nullptr ? old_outline->touched(y) : Columns{};
      const Columns new_touched = new_outline != nullptr ? new_outline->touched(y) : Columns{};
      const Columns old_inside = old_outline != nullptr ? old_outline->inside(y) : Columns{};
      const Columns new_inside = new_outline != nullptr ? new_outline->inside(y) : Columns{};
      if (everything || old_inside.empty() || new_inside.empty()) {
        if (!old_touched.empty()) mark(y, old_touched);
        if (!new_touched.empty()) mark(y, new_touched);
        continue;
      }
      mark(y, {std::min(old_touched.begin, new_touched.begin),
               std::max(old_inside.begin, new_inside.begin)});
      mark(y,
           {std::min(old_inside.end, new_inside.end), std::max(old_touched.end, new_touched.end)});
    }
  }
}

void SceneRenderer::draw_bodies(const std::vector<SceneBody>& bodies,
                                const std::vector<int>& nearest_first,
                                const std::vector<bool>& moved, Timestamp from, Timestamp to,
                                EventSensor& sensor) {
  drawn_.resize(bodies.size());
  const bool reordered = nearest_first != drawn_nearest_first_;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!moved[i] && !reordered) continue;
    mark_changes(drawn_[i], bodies[i], reordered);
    drawn_[i] = bodies[i];
  }
  drawn_nearest_first_ = nearest_first;

  for (int y = 0; y < size_.height; ++y) {
    std::vector<Columns>& row = to_draw_[static_cast<std::size_t>(y)];
    if (row.empty()) continue;
    std::sort(row.begin(), row.end(), [](Columns a, Columns b) { return a.begin < b.begin; });
    Columns next = row.front();
    for (const Columns& columns : row) {
      if (columns.begin > next.end) {
        draw_columns(y, next, bodies, nearest_first, from, to, sensor);
        next = columns;
      }
      next.end = std::max(next.end, columns.end);
    }
    draw_columns(y, next, bodies, nearest_first, from, to, sensor);
    row.clear();
  }
}

void SceneRenderer::draw_columns(int y, Columns columns, const std::vector<SceneBody>& bodies,
                                 const std::vector<int>& nearest_first, Timestamp from,
                                 Timestamp to, EventSensor& sensor) {
  blend_.start(y, columns);
  for (const int body : nearest_first) blend_.add(bodies[static_cast<std::size_t>(body)]);
  for (int x = columns.begin; x < columns.end; ++x) {
    sensor.change(x, y, blend_.log_light_over(x, background_(x, y)), from, to);
  }
}

}  // namespace puck
