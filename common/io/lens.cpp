#include "common/io/lens.h"

#include <cmath>
#include <numbers>

namespace puck {
namespace {

constexpr int kSteps = 100;
// On the plane at distance 1: far below a pixel.
constexpr double kCloseEnough = 1e-10;

// A point of the plane at distance 1 before the camera.
struct PlanePoint {
  double x = 0;
  double y = 0;
};

// The distorted point and its derivatives by the undistorted one.
struct Distorted {
  PlanePoint at;
  double dx_dx = 0;
  double dx_dy = 0;
  double dy_dy = 0;

  double determinant() const { return dx_dx * dy_dy - dx_dy * dx_dy; }
};

// The formulas of OpenCV's documentation of calib3d, with the names that they have there.
Distorted distorted(PlanePoint at, const std::array<double, 5>& distortion) {
  const auto [k1, k2, p1, p2, k3] = distortion;
  const auto [x, y] = at;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2 * (k1 + r2 * (2 * k2 + r2 * 3 * k3));  // Of radial, by r2, times 2.
  return {.at = {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                 y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y},
          .dx_dx = radial + x * x * slope + 2 * p1 * y + 6 * p2 * x,
          .dx_dy = x * y * slope + 2 * p1 * x + 2 * p2 * y,
          .dy_dy = radial + y * y * slope + 6 * p1 * y + 2 * p2 * x};
}

// Newton's method. It begins at the distorted point, from where it meets no other solution first.
std::optional<PlanePoint> undistorted_pinhole(PlanePoint target,
                                              const std::array<double, 5>& distortion) {
  PlanePoint at = target;
  for (int step = 0; step < kSteps; ++step) {
    const Distorted now = distorted(at, distortion);
    const double determinant = now.determinant();
    // Beyond the fold the picture is reversed.
    if (!(determinant > 0) || !(now.dx_dx > 0)) return std::nullopt;
    const double error_x = target.x - now.at.x;
    const double error_y = target.y - now.at.y;
    if (std::abs(error_x) + std::abs(error_y) < kCloseEnough) return at;
    at.x += (now.dy_dy * error_x - now.dx_dy * error_y) / determinant;
    at.y += (now.dx_dx * error_y - now.dx_dy * error_x) / determinant;
  }
  return std::nullopt;
}

std::optional<PlanePoint> undistorted_fisheye(PlanePoint target,
                                              const std::array<double, 5>& distortion) {
  const auto [k1, k2, k3, k4, unused] = distortion;
  const double theta_d = std::hypot(target.x, target.y);
  if (theta_d < kCloseEnough) return target;
  double theta = theta_d;
  for (int step = 0; step < kSteps; ++step) {
    const double t2 = theta * theta;
    const double value = theta * (1 + t2 * (k1 + t2 * (k2 + t2 * (k3 + t2 * k4))));
    const double slope = 1 + t2 * (3 * k1 + t2 * (5 * k2 + t2 * (7 * k3 + t2 * 9 * k4)));
    if (!(slope > 0)) return std::nullopt;
    const double error = theta_d - value;
    if (std::abs(error) < kCloseEnough) {
      if (theta < 0 || theta >= std::numbers::pi / 2) return std::nullopt;
      const double scale = std::tan(theta) / theta_d;
      return PlanePoint{target.x * scale, target.y * scale};
    }
    theta += error / slope;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Pixel> Lens::undistorted(Pixel seen) const {
  const PlanePoint target{(seen.x - cx_px) / fx_px, (seen.y - cy_px) / fy_px};
  const std::optional<PlanePoint> at = model == Model::kPinhole
                                           ? undistorted_pinhole(target, distortion)
                                           : undistorted_fisheye(target, distortion);
  if (!at) return std::nullopt;
  return Pixel{at->x * fx_px + cx_px, at->y * fy_px + cy_px};
}

}  // namespace puck
