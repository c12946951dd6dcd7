#include "common/simulation/convex_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace puck {
namespace {

constexpr double kFar_px = 1e5;
constexpr int kInside_px = 2;  // Diamond around a pixel that contains its blurred edge.
constexpr int kAround_px = 1;

// Andrew's monotone chain, counter-clockwise.
std::vector<Pixel> hull_of(std::vector<Pixel> points) {
  std::sort(points.begin(), points.end(),
            [](Pixel a, Pixel b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  const auto turns_left = [](Pixel a, Pixel b, Pixel c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
  };
  std::vector<Pixel> hull;
  hull.reserve(points.size() + 1);
  const auto add = [&](Pixel point, std::size_t start) {
    while (hull.size() >= start + 2 && !turns_left(hull[hull.size() - 2], hull.back(), point)) {
      hull.pop_back();
    }
    hull.push_back(point);
  };
  for (const Pixel& point : points) add(point, 0);
  const std::size_t lower_end = hull.size() - 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower_end);
  return hull;
}

/// The hull's columns at one y.
struct Cut {
  double left = std::numeric_limits<double>::infinity();
  double right = -std::numeric_limits<double>::infinity();

  void include(double x) {
    left = std::min(left, x);
    right = std::max(right, x);
  }
};

}  // namespace

ConvexOutline::ConvexOutline(std::vector<Pixel> points, int image_height) {
  double top = kFar_px;
  double bottom = -kFar_px;
  for (Pixel& point : points) {
    point = {std::clamp(point.x, -kFar_px, kFar_px), std::clamp(point.y, -kFar_px, kFar_px)};
    top = std::min(top, point.y);
    bottom = std::max(bottom, point.y);
  }
  first_row_ = std::clamp(static_cast<int>(std::floor(top)) - kAround_px, 0, image_height);
  const int end_row =
      std::clamp(static_cast<int>(std::ceil(bottom)) + kAround_px + 1, first_row_, image_height);
  if (points.empty() || first_row_ == end_row) return;

  // `cuts`: where the hull crosses each row's centre line. `spans`: the columns of the hull's
  // corners near the row. Both from two rows above the first row to two below the last.
  const int origin = first_row_ - kInside_px;
  const int count = end_row - first_row_ + 2 * kInside_px;
  std::vector<Cut> cuts(static_cast<std::size_t>(count));
  std::vector<Cut> spans(static_cast<std::size_t>(count));
  const std::vector<Pixel> hull = hull_of(std::move(points));
  for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
    const Pixel& upper = hull[i].y < hull[i + 1].y ? hull[i] : hull[i + 1];
    const Pixel& lower = hull[i].y < hull[i + 1].y ? hull[i + 1] : hull[i];
    const int first = std::max(origin, static_cast<int>(std::ceil(upper.y)));
    const int last = std::min(origin + count - 1, static_cast<int>(std::floor(lower.y)));
    const double slope = lower.y > upper.y ? (lower.x - upper.x) / (lower.y - upper.y) : 0;
    for (int y = first; y <= last; ++y) {
      cuts[static_cast<std::size_t>(y - origin)].include(upper.x + slope * (y - upper.y));
    }
    for (int y = static_cast<int>(std::floor(hull[i].y)) - kAround_px + 1;
         y <= static_cast<int>(std::ceil(hull[i].y)) + kAround_px - 1; ++y) {
      if (y >= origin && y < origin + count) {
        spans[static_cast<std::size_t>(y - origin)].include(hull[i].x);
      }
    }
  }

  for (int y = first_row_; y < end_row; ++y) {
    const auto row = static_cast<std::size_t>(y - origin);
    Cut around = spans[row];
    for (std::size_t near = row - kAround_px; near <= row + kAround_px; ++near) {
      around.left = std::min(around.left, cuts[near].left);
      around.right = std::max(around.right, cuts[near].right);
    }
    Columns touched;
    if (around.left <= around.right) {
      touched = {static_cast<int>(std::floor(around.left)) - kAround_px,
                 static_cast<int>(std::ceil(around.right)) + kAround_px + 1};
    }
    const Cut& above = cuts[row - kInside_px];
    const Cut& below = cuts[row + kInside_px];
    const double left = std::max({above.left, below.left, cuts[row].left + kInside_px});
    const double right = std::min({above.right, below.right, cuts[row].right - kInside_px});
    Columns inside;
    if (left <= right) {
      inside = {static_cast<int>(std::ceil(left)), static_cast<int>(std::floor(right)) + 1};
    }
    touched_.push_back(touched);
    inside_.push_back(inside);
  }
}

Columns ConvexOutline::touched(int y) const {
  if (y < first_row_ || y >= end_row()) return {};
  return touched_[static_cast<std::size_t>(y - first_row_)];
}

Columns ConvexOutline::inside(int y) const {
  if (y < first_row_ || y >= end_row()) return {};
  return inside_[static_cast<std::size_t>(y - first_row_)];
}

}  // namespace puck
