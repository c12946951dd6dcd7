#include "common/vision/geometry/disc_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace puck {
namespace {

// Growth of the width from row to row, px/px.
constexpr double kLeastGrowth = 0.005;
// In diameters: a puck of 8 cm is at least about 4 mm thick.
constexpr double kThinnest = 0.05;

}  // namespace

double DiscModel::width_at(Pixel position) const {
  return std::max(width_0 + width_x * position.x + width_y * position.y, kSmallestWidth_px);
}

double DiscModel::sine_of_tilt() const {
  return std::clamp(width_at({principal_x_px, principal_y_px}) / face_on_px, 0.01, 0.9999);
}

PuckSize DiscModel::at(Pixel position) const {
  const double width = width_at(position);
  const double foreshortening = width / face_on_px;
  const double disc_height = width * foreshortening;
  const double aside = width_y * std::abs(position.x - principal_x_px);
  const double slant = aside / width;
  const double sine = sine_of_tilt();
  const double cosine = std::sqrt(1 - sine * sine);
  const double wall = thickness * width / cosine;
  return {std::hypot(width, slant * disc_height) + wall * sine * aside / face_on_px,
          disc_height + wall * (1 - foreshortening * sine)};
}

double DiscModel::wall_of_width() const {
  const double sine = sine_of_tilt();
  return thickness < kThinnest ? 0 : thickness * std::sqrt(1 - sine * sine);
}

double DiscModel::ordinary_wall() const {
  const double sine = sine_of_tilt();
  return kOrdinaryThickness * std::sqrt(1 - sine * sine);
}

double DiscModel::wall_profile(Pixel position) const {
  const double sine = sine_of_tilt();
  return std::max(1 - width_at(position) / face_on_px * sine, 0.0) / (1 - sine * sine);
}

double DiscModel::tilt_deg() const { return std::asin(sine_of_tilt()) * 180 / std::numbers::pi; }

double DiscModel::focal_px() const {
  const double sine = sine_of_tilt();
  return face_on_px * std::sqrt(1 - sine * sine) / std::hypot(width_x, width_y);
}

bool DiscModel::has_perspective() const { return width_y > kLeastGrowth; }

}  // namespace puck
