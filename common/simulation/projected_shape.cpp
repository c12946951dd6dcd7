#include "common/simulation/projected_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace puck {
namespace {

// Width of a blurred edge: the pixel's own width and the lens's blur.
constexpr float kEdge_px = 1.5f;

float share_of(float inside_px) {
  const float share = std::clamp(inside_px / kEdge_px + 0.5f, 0.0f, 1.0f);
  return share * share * (3 - 2 * share);
}

struct Extent {
  double low = 0;
  double high = 0;
};

// The extent of a circle's image along x (rows 0 and 2 of the projection) or y (rows 1 and 2): the
// tangents of an ellipse are the points of its dual conic, H diag(r², r², −1) Hᵀ for a circle.
Extent extent_of(const std::array<double, 9>& h, TablePoint centre, double radius_m, int row) {
  const auto column = [&](int r, int c) {
    return c < 2 ? radius_m * h[3 * r + c]
                 : h[3 * r] * centre.x_m + h[3 * r + 1] * centre.y_m + h[3 * r + 2];
  };
  const auto dual = [&](int r, int s) {
    return column(r, 0) * column(s, 0) + column(r, 1) * column(s, 1) - column(r, 2) * column(s, 2);
  };
  const double a = dual(2, 2);
  const double b = dual(row, 2);
  const double c = dual(row, row);
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  const double one = (b + root) / a;
  const double other = (b - root) / a;
  return {std::min(one, other), std::max(one, other)};
}

// Corners of each circle's outline: a polygon of 24 lies within 1 % of the radius.
constexpr int kCorners = 24;

Pixel direction_of(int corner) {
  const double angle = 2 * std::numbers::pi * corner / kCorners;
  return {std::cos(angle), std::sin(angle)};
}

ConvexOutline outline_of(const CameraView& view, TablePoint centre, double radius_m,
                         double bottom_m, double top_m) {
  std::vector<Pixel> points;
  points.reserve(2 * kCorners);
  for (int i = 0; i < kCorners; ++i) {
    const Pixel direction = direction_of(i);
    for (const double height_m : {bottom_m, top_m}) {
      const auto seen = view.project(
          {centre.x_m + radius_m * direction.x, centre.y_m + radius_m * direction.y, height_m});
      if (seen) points.push_back(seen->pixel);
    }
  }
  return {std::move(points), view.size().height};
}

}  // namespace

ProjectedCylinder::ProjectedCylinder(const CameraView& view, TablePoint centre, double radius_m,
                                     double bottom_m, double top_m)
    : centre_to_camera_(view.centre() - Vector3{centre.x_m, centre.y_m, 0}),
      first_ray_(view.ray({0, 0})),
      ray_x_((1 / view.focal_px()) * view.right()),
      ray_y_((1 / view.focal_px()) * view.down()),
      radius_m_(radius_m),
      bottom_m_(bottom_m),
      top_m_(top_m),
      outline_(outline_of(view, centre, radius_m, bottom_m, top_m)) {
  const auto lower = view.image_from_plane(bottom_m);
  const auto upper = view.image_from_plane(top_m);
  const Extent lower_x = extent_of(lower, centre, radius_m, 0);
  const Extent lower_y = extent_of(lower, centre, radius_m, 1);
  const Extent upper_x = extent_of(upper, centre, radius_m, 0);
  const Extent upper_y = extent_of(upper, centre, radius_m, 1);
  const double left = std::min(lower_x.low, upper_x.low);
  const double right = std::max(lower_x.high, upper_x.high);
  const double top = std::min(lower_y.low, upper_y.low);
  const double bottom = std::max(lower_y.high, upper_y.high);
  box_ = {{(left + right) / 2, (top + bottom) / 2}, {right - left, bottom - top}};
}

// A pixel's ray passes the cylinder's bottom plane at A and its top plane at B. It meets the
// cylinder where the segment from A to B, seen from above, comes closer to the axis than the
// radius.
void ProjectedCylinder::coverage(int y, int first, int count, float* shares) const {
  const Vector3 row_ray = first_ray_ + static_cast<double>(y) * ray_y_;
  const float cx = static_cast<float>(centre_to_camera_.x);
  const float cy = static_cast<float>(centre_to_camera_.y);
  const float to_bottom_z = static_cast<float>(bottom_m_ - centre_to_camera_.z);
  const float to_top_z = static_cast<float>(top_m_ - centre_to_camera_.z);
  const float xx = static_cast<float>(ray_x_.x), xy = static_cast<float>(ray_x_.y),
              xz = static_cast<float>(ray_x_.z);
  const float yx = static_cast<float>(ray_y_.x), yy = static_cast<float>(ray_y_.y),
              yz = static_cast<float>(ray_y_.z);
  const float radius = static_cast<float>(radius_m_);
  for (int i = 0; i < count; ++i) {
    const double column = first + i;
    const float dx = static_cast<float>(row_ray.x + column * ray_x_.x);
    const float dy = static_cast<float>(row_ray.y + column * ray_x_.y);
    const float dz = static_cast<float>(row_ray.z + column * ray_x_.z);
    if (!(dz < -1e-6f)) {
      shares[i] = 0;
      continue;
    }
    const float per_z = 1 / dz;
    // Where on the segment from B to A the ray is closest to the axis.
    const float nearest = -(cx * dx + cy * dy) / std::max(dx * dx + dy * dy, 1e-12f);
    const float t = std::clamp(nearest, to_top_z * per_z, to_bottom_z * per_z);
    const float px = cx + t * dx;
    const float py = cy + t * dy;
    const float distance = std::sqrt(px * px + py * py);
    const float per_distance = 1 / std::max(distance, 1e-6f);
    const float nx = px * per_distance;
    const float ny = py * per_distance;
    // Change of the distance from pixel to pixel, m/px.
    const float along = (nx * dx + ny * dy) * per_z;
    const float gx = t * (nx * xx + ny * xy - along * xz);
    const float gy = t * (nx * yx + ny * yy - along * yz);
    const float growth = std::sqrt(gx * gx + gy * gy);
    shares[i] = share_of((radius - distance) / std::max(growth, 1e-9f));
  }
}

ProjectedCapsule::Circle ProjectedCapsule::circle_of(const CameraView& view, Vector3 centre,
                                                     double radius_m) {
  const auto seen = view.project(centre);
  if (!seen) return {};
  return {seen->pixel, view.focal_px() * radius_m / seen->depth_m};
}

ProjectedCapsule::ProjectedCapsule(const CameraView& view, Vector3 from, double from_radius_m,
                                   Vector3 to, double to_radius_m)
    : from_(circle_of(view, from, from_radius_m)),
      to_(circle_of(view, to, to_radius_m)),
      outline_([&] {
        std::vector<Pixel> points;
        points.reserve(2 * kCorners);
        for (int i = 0; i < kCorners; ++i) {
          const Pixel direction = direction_of(i);
          for (const Circle& circle : {from_, to_}) {
            points.push_back({circle.centre.x + circle.radius_px * direction.x,
                              circle.centre.y + circle.radius_px * direction.y});
          }
        }
        // An end behind the camera: the capsule is not drawn.
        if (from_.radius_px <= 0 || to_.radius_px <= 0) points.clear();
        return ConvexOutline(std::move(points), view.size().height);
      }()) {}

void ProjectedCapsule::coverage(int y, int first, int count, float* shares) const {
  const float dx = static_cast<float>(to_.centre.x - from_.centre.x);
  const float dy = static_cast<float>(to_.centre.y - from_.centre.y);
  const float per_square = 1 / std::max(dx * dx + dy * dy, 1e-6f);
  const float radius = static_cast<float>(from_.radius_px);
  const float radius_change = static_cast<float>(to_.radius_px - from_.radius_px);
  const float offset_y = static_cast<float>(y - from_.centre.y);
  for (int i = 0; i < count; ++i) {
    const float offset_x = static_cast<float>(first + i - from_.centre.x);
    const float along = std::clamp((offset_x * dx + offset_y * dy) * per_square, 0.0f, 1.0f);
    const float px = offset_x - along * dx;
    const float py = offset_y - along * dy;
    shares[i] = share_of(radius + along * radius_change - std::sqrt(px * px + py * py));
  }
}

}  // namespace puck
