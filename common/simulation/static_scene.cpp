#include "common/simulation/static_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace puck {
namespace {

constexpr double kWallBehind_m = 1.6;  // Distance beyond the opponent's end.
constexpr double kTile_m = 0.4;
constexpr double kPanel_m = 0.7;

struct Spot {
  double x_m = 0;
  double y_m = 0;
};
constexpr std::array<Spot, SceneParams::kMostLogos> kLogos{
    Spot{0.75, -0.35}, Spot{1.40, -0.05}, Spot{0.55, 0.30},  Spot{1.30, 0.40},
    Spot{0.60, -0.05}, Spot{1.28, -0.38}, Spot{1.70, -0.42}, Spot{1.85, 0.45}};

bool is_odd(double cell) { return std::fmod(std::floor(cell), 2.0) != 0; }

}  // namespace

StaticScene::StaticScene(const TableGeometry& table, const SceneParams& params)
    : table_(table),
      params_(params),
      // As on the table of the paper's authors, seen from the robot's end.
      stars_{Star{0.14, -0.22}, Star{0.14, 0.20}, Star{1.54, -0.22}, Star{1.54, 0.20}} {}

double StaticScene::luminance(Vector3 from, Vector3 direction) const {
  if (direction.z < 0) {
    const double to_table = -from.z / direction.z;
    const double x_m = from.x + to_table * direction.x;
    const double y_m = from.y + to_table * direction.y;
    const double rail_m = params_.rail_width_m;
    if (x_m > -rail_m && x_m < table_.length_m + rail_m &&
        std::abs(y_m) < table_.width_m / 2 + rail_m) {
      return table_luminance(x_m, y_m);
    }
    const double to_floor = -(from.z + params_.table_height_m) / direction.z;
    const double floor_x_m = from.x + to_floor * direction.x;
    if (floor_x_m < table_.length_m + kWallBehind_m) {
      return floor_luminance(floor_x_m, from.y + to_floor * direction.y);
    }
  }
  if (direction.x <= 0) return params_.wall_luminance;
  const double to_wall = (table_.length_m + kWallBehind_m - from.x) / direction.x;
  return wall_luminance(from.y + to_wall * direction.y, from.z + to_wall * direction.z);
}

double StaticScene::table_luminance(double x_m, double y_m) const {
  const bool on_side_rail = std::abs(y_m) > table_.width_m / 2;
  const bool on_end_rail = x_m < 0 || x_m > table_.length_m;
  if (on_end_rail && std::abs(y_m) < table_.goal_width_m / 2) return params_.goal_luminance;
  if (on_side_rail || on_end_rail) return params_.rail_luminance;
  if (on_line(x_m, y_m)) return params_.line_luminance;
  if (on_star(x_m, y_m)) return params_.star_luminance;
  if (on_logo(x_m, y_m)) return params_.logo_luminance;
  return params_.table_luminance;
}

bool StaticScene::on_line(double x_m, double y_m) const {
  const double half_m = params_.line_width_m / 2;
  const double middle_m = table_.length_m / 2;
  const auto on_circle = [&](double centre_x_m, double radius_m) {
    return std::abs(std::hypot(x_m - centre_x_m, y_m) - radius_m) < half_m;
  };
  return std::abs(x_m - middle_m) < half_m || on_circle(middle_m, params_.circle_radius_m) ||
         on_circle(0, params_.goal_arc_radius_m) ||
         on_circle(table_.length_m, params_.goal_arc_radius_m);
}

bool StaticScene::on_star(double x_m, double y_m) const {
  // A five-pointed star: the points in at least four of the five half planes that its lines bound.
  const double inner_m = params_.star_radius_m * std::cos(0.4 * std::numbers::pi);
  for (const Star& star : stars_) {
    const double dx_m = x_m - star.x_m;
    const double dy_m = y_m - star.y_m;
    if (std::hypot(dx_m, dy_m) > params_.star_radius_m) continue;
    int inside = 0;
    for (int i = 0; i < 5; ++i) {
      const double angle = (0.2 + 0.4 * i) * std::numbers::pi;
      if (dx_m * std::cos(angle) + dy_m * std::sin(angle) < inner_m) ++inside;
    }
    if (inside >= 4) return true;
  }
  return false;
}

bool StaticScene::on_logo(double x_m, double y_m) const {
  return std::any_of(kLogos.begin(), kLogos.begin() + params_.logo_count, [&](const Spot& logo) {
    return std::hypot(x_m - logo.x_m, y_m - logo.y_m) < params_.logo_radius_m;
  });
}

double StaticScene::floor_luminance(double x_m, double y_m) const {
  const double half = params_.floor_contrast / 2;
  const bool dark = is_odd(x_m / kTile_m) != is_odd(y_m / kTile_m);
  return params_.floor_luminance * std::exp(dark ? -half : half);
}

double StaticScene::wall_luminance(double y_m, double z_m) const {
  constexpr double kDarker = 0.6;
  constexpr double kSkirting_m = 0.1;
  const bool skirting = z_m < kSkirting_m - params_.table_height_m;
  const bool dark = skirting || is_odd(y_m / kPanel_m);
  return params_.wall_luminance * (dark ? kDarker : 1);
}

}  // namespace puck
