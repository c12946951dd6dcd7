#include "common/table/table_camera.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/table/require.h"

namespace puck {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

const PinholeCamera& checked(const PinholeCamera& camera) {
  require(camera.focal_px >= 10 && camera.focal_px <= 100'000,
          "camera.focal_px must be between 10 and 100000", camera.focal_px);
  require(std::abs(camera.principal_point.x) <= 100'000,
          "camera.principal_x_px must be within 100000", camera.principal_point.x);
  require(std::abs(camera.principal_point.y) <= 100'000,
          "camera.principal_y_px must be within 100000", camera.principal_point.y);
  for (const double distance_m : camera.pivot_m) {
    require(std::abs(distance_m) <= 10, "camera.pivot_m must be within 10 m", distance_m);
  }
  return camera;
}

Matrix3 projection_of(const PinholeCamera& camera) {
  return {camera.focal_px,
          0,
          camera.principal_point.x,
          0,
          camera.focal_px,
          camera.principal_point.y,
          0,
          0,
          1};
}

Matrix3 ray_of(const PinholeCamera& camera) {
  const double f = camera.focal_px;
  return {1 / f, 0, -camera.principal_point.x / f, 0, 1 / f, -camera.principal_point.y / f, 0,
          0,     1};
}

// A rotation about one of the camera's axes and its rate per second.
struct Turn {
  Matrix3 matrix;
  Matrix3 rate;
};

Turn yaw_of(double deg, double deg_s) {
  const double c = std::cos(deg * kDegree), s = std::sin(deg * kDegree), w = deg_s * kDegree;
  return {{c, 0, s, 0, 1, 0, -s, 0, c}, scaled({-s, 0, c, 0, 0, 0, -c, 0, -s}, w)};
}

Turn pitch_of(double deg, double deg_s) {
  const double c = std::cos(deg * kDegree), s = std::sin(deg * kDegree), w = deg_s * kDegree;
  return {{1, 0, 0, 0, c, -s, 0, s, c}, scaled({0, 0, 0, 0, -s, -c, 0, c, -s}, w)};
}

Turn roll_of(double deg, double deg_s) {
  const double c = std::cos(deg * kDegree), s = std::sin(deg * kDegree), w = deg_s * kDegree;
  return {{c, -s, 0, s, c, 0, 0, 0, 1}, scaled({-s, -c, 0, c, -s, 0, 0, 0, 0}, w)};
}

Turn one_after(const Turn& a, const Turn& b) {
  return {product(a.matrix, b.matrix), sum(product(a.rate, b.matrix), product(a.matrix, b.rate))};
}

// Adds `vector` to the third column.
Matrix3 shifted(Matrix3 matrix, const Column3& vector) {
  matrix[2] += vector[0];
  matrix[5] += vector[1];
  matrix[8] += vector[2];
  return matrix;
}

Column3 times(const std::array<double, 3>& v, double factor) {
  return {v[0] * factor, v[1] * factor, v[2] * factor};
}

}  // namespace

TableCamera::TableCamera(const Homography& home, const PinholeCamera& camera)
    : camera_(checked(camera)),
      camera_from_table_(product(ray_of(camera), home.image_from_table())) {
  // The first two columns are the table's axes, unit vectors times the scale.
  const Matrix3& c = camera_from_table_;
  scale_ = std::sqrt(std::hypot(c[0], c[3], c[6]) * std::hypot(c[1], c[4], c[7]));
}

std::optional<TableView> TableCamera::view_at(const HeadPose& pose) const {
  // Axes of the turned camera in the frame of the home pose. The rotation is intrinsic: each turn
  // is about an axis of the camera as already turned.
  const Turn turn = one_after(
      one_after(yaw_of(pose.yaw_deg, pose.yaw_deg_s), pitch_of(pose.pitch_deg, pose.pitch_deg_s)),
      roll_of(pose.roll_deg, pose.roll_deg_s));
  // From the pivot, which stays, to a point of the table: at home, then turned, then from the
  // camera again.
  const Matrix3 from_pivot = shifted(camera_from_table_, times(camera_.pivot_m, -scale_));
  const Matrix3 projection = projection_of(camera_);
  const std::optional<Homography> homography =
      Homography::of_view(product(projection, shifted(product(transposed(turn.matrix), from_pivot),
                                                      times(camera_.pivot_m, scale_))));
  if (!homography) return std::nullopt;
  const Matrix3 image_rate = product(projection, product(transposed(turn.rate), from_pivot));
  // (G⁻¹)' = −G⁻¹ G' G⁻¹
  const Matrix3& inverse = homography->table_from_image();
  return TableView{*homography, scaled(product(product(inverse, image_rate), inverse), -1)};
}

Homography TableCamera::raised(double height_m) const {
  // Up is the cross product of the table's axes: x forwards, y to the left.
  const Matrix3& c = camera_from_table_;
  const double factor = height_m / scale_;
  const Column3 up{(c[3] * c[7] - c[6] * c[4]) * factor, (c[6] * c[1] - c[0] * c[7]) * factor,
                   (c[0] * c[4] - c[3] * c[1]) * factor};
  const auto homography =
      Homography::of_view(product(projection_of(camera_), shifted(camera_from_table_, up)));
  if (!homography) {
    throw std::invalid_argument("the camera must not lie at the requested height");
  }
  return *homography;
}

}  // namespace puck
