#include "tools/view/drawing/canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include <opencv2/imgproc.hpp>

namespace puck {
namespace {

// OpenCV takes positions in 1/16 px.
constexpr int kShift = 4;
constexpr double kUnitsPerPx = 1 << kShift;
// Farther marks are cut off by hand: OpenCV's positions have 32 bits.
constexpr double kFarthest_px = 1e5;
constexpr double kRound_px = 2.5;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
// Height of the font's capitals at scale 1, px.
constexpr double kFontHeight_px = 21;

bool is_drawable(cv::Point2d point) {
  // Also false for NaN.
  return std::abs(point.x) < kFarthest_px && std::abs(point.y) < kFarthest_px;
}

cv::Point in_units(cv::Point2d point) {
  return {static_cast<int>(std::lround(point.x * kUnitsPerPx)),
          static_cast<int>(std::lround(point.y * kUnitsPerPx))};
}

int thickness_of(double height_px) { return height_px >= 15 ? 2 : 1; }

// The parts of a line of points that a dashed pen draws.
std::vector<std::vector<cv::Point2d>> dashes_of(const std::vector<cv::Point2d>& points, bool closed,
                                                double dash_px) {
  std::vector<std::vector<cv::Point2d>> dashes;
  double left_px = dash_px;
  bool draws = true;
  const std::size_t lines = closed ? points.size() : points.size() - 1;
  for (std::size_t i = 0; i < lines; ++i) {
    const cv::Point2d from = points[i];
    const cv::Point2d way = points[(i + 1) % points.size()] - from;
    const double length_px = std::hypot(way.x, way.y);
    double done_px = 0;
    if (draws && (i == 0 || dashes.empty())) dashes.push_back({from});
    while (length_px - done_px > left_px) {
      done_px += left_px;
      const cv::Point2d at = from + way * (done_px / length_px);
      if (draws) {
        dashes.back().push_back(at);
      } else {
        dashes.push_back({at});
      }
      draws = !draws;
      // The pen is round: it lengthens the dashes.
      left_px = draws ? dash_px : dash_px + kRound_px;
    }
    left_px -= length_px - done_px;
    if (draws) dashes.back().push_back(from + way);
  }
  return dashes;
}

}  // namespace

void Canvas::strokes(const std::vector<cv::Point2d>& points, bool closed, const cv::Scalar& colour,
                     int width_px) {
  std::vector<cv::Point> units;
  units.reserve(points.size());
  for (const cv::Point2d& point : points) units.push_back(in_units(point));
  cv::polylines(picture_, units, closed, colour, width_px, cv::LINE_AA, kShift);
}

void Canvas::polyline(const std::vector<cv::Point2d>& points, bool closed, const Stroke& stroke) {
  if (points.size() < 2 || !std::all_of(points.begin(), points.end(), is_drawable)) return;
  if (stroke.dash_px > 0) {
    const auto dashes = dashes_of(points, closed, stroke.dash_px);
    for (const bool is_halo : {true, false}) {
      if (is_halo && !stroke.has_halo) continue;
      for (const auto& dash : dashes) {
        strokes(dash, false, is_halo ? stroke.halo : stroke.colour,
                stroke.width_px + (is_halo ? 2 : 0));
      }
    }
    return;
  }
  if (stroke.has_halo) strokes(points, closed, stroke.halo, stroke.width_px + 2);
  strokes(points, closed, stroke.colour, stroke.width_px);
}

void Canvas::line(cv::Point2d from, cv::Point2d to, const Stroke& stroke) {
  polyline({from, to}, false, stroke);
}

void Canvas::rectangle(cv::Point2d from, cv::Point2d to, const Stroke& stroke) {
  polyline({from, {to.x, from.y}, to, {from.x, to.y}}, true, stroke);
}

void Canvas::ellipse(cv::Point2d centre, cv::Size2d axes, double turn_rad, const Stroke& stroke) {
  if (!(axes.width > 0 && axes.height > 0)) return;
  const double largest_px = std::max(axes.width, axes.height);
  const int corners = static_cast<int>(std::clamp(largest_px, 24.0, 180.0));
  std::vector<cv::Point2d> points;
  points.reserve(static_cast<std::size_t>(corners));
  const double c = std::cos(turn_rad);
  const double s = std::sin(turn_rad);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double x = axes.width * std::cos(angle);
    const double y = axes.height * std::sin(angle);
    points.emplace_back(centre.x + c * x - s * y, centre.y + s * x + c * y);
  }
  polyline(points, true, stroke);
}

void Canvas::arrow(cv::Point2d from, cv::Point2d to, double head_px, const Stroke& stroke) {
  const cv::Point2d way = to - from;
  const double length_px = std::hypot(way.x, way.y);
  if (!(length_px > head_px)) return;
  const cv::Point2d along = way / length_px;
  const cv::Point2d across{-along.y, along.x};
  line(from, to, stroke);
  Stroke head = stroke;
  head.dash_px = 0;
  polyline({to - along * head_px + across * (head_px * 0.55), to,
            to - along * head_px - across * (head_px * 0.55)},
           false, head);
}

void Canvas::filled_circle(cv::Point2d centre, double radius_px, const cv::Scalar& colour) {
  if (!is_drawable(centre) || !(radius_px > 0 && radius_px < kFarthest_px)) return;
  cv::circle(picture_, in_units(centre), static_cast<int>(std::lround(radius_px * kUnitsPerPx)),
             colour, cv::FILLED, cv::LINE_AA, kShift);
}

void Canvas::filled_polygon(const std::vector<cv::Point2d>& points, const cv::Scalar& colour) {
  if (points.size() < 3 || !std::all_of(points.begin(), points.end(), is_drawable)) return;
  std::vector<cv::Point> units;
  for (const cv::Point2d& point : points) units.push_back(in_units(point));
  cv::fillPoly(picture_, std::vector{units}, colour, cv::LINE_AA, kShift);
}

double Canvas::text_width(const std::string& words, double height_px) {
  int baseline = 0;
  return cv::getTextSize(words, kFont, height_px / kFontHeight_px, thickness_of(height_px),
                         &baseline)
      .width;
}

void Canvas::text(const std::string& words, cv::Point2d at, double height_px,
                  const cv::Scalar& colour, Align align) {
  if (!is_drawable(at)) return;
  if (align != Align::kLeft) {
    at.x -= text_width(words, height_px) * (align == Align::kMiddle ? 0.5 : 1);
  }
  cv::putText(
      picture_, words,
      {static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y + height_px / 2))},
      kFont, height_px / kFontHeight_px, colour, thickness_of(height_px), cv::LINE_AA);
}

void Canvas::paragraph(const std::string& words, cv::Point2d middle, double width_px,
                       double height_px, const cv::Scalar& colour) {
  std::vector<std::string> lines;
  std::istringstream rest(words);
  for (std::string word; rest >> word;) {
    if (lines.empty() || text_width(lines.back() + " " + word, height_px) > width_px) {
      lines.push_back(word);
    } else {
      lines.back() += " " + word;
    }
  }
  const double step_px = 2 * height_px;
  middle.y -= (static_cast<double>(lines.size()) - 1) / 2 * step_px;
  for (const std::string& line : lines) {
    text(line, middle, height_px, colour, Align::kMiddle);
    middle.y += step_px;
  }
}

void Canvas::label(const std::string& words, cv::Point2d at, double height_px,
                   const cv::Scalar& colour, const cv::Scalar& box) {
  if (!is_drawable(at)) return;
  const double width_px = text_width(words, height_px);
  const double half_px = height_px * 0.9;
  at.x = std::clamp(at.x, half_px, std::max(half_px, picture_.cols - width_px - half_px));
  at.y = std::clamp(at.y, half_px, std::max(half_px, picture_.rows - half_px));
  const cv::Rect place(
      cv::Point(static_cast<int>(at.x - half_px * 0.6), static_cast<int>(at.y - half_px)),
      cv::Point(static_cast<int>(at.x + width_px + half_px * 0.6),
                static_cast<int>(at.y + half_px)));
  cv::rectangle(picture_, place, box, cv::FILLED);
  text(words, at, height_px, colour);
}

}  // namespace puck
