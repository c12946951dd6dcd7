#include "common/table/table_camera.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/Geometry>
#include <Eigen/LU>

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
  const Pixel& middle = camera.principal_point;
  return Matrix3{{camera.focal_px, 0, middle.x}, {0, camera.focal_px, middle.y}, {0, 0, 1}};
}

// A rotation about one of the camera's axes and its rate per second.
struct Turn {
  Matrix3 matrix;
  Matrix3 rate;
};

Turn turn_about(const Column3& axis, double deg, double deg_s) {
  const Matrix3 matrix = Eigen::AngleAxisd(deg * kDegree, axis).toRotationMatrix();
  Matrix3 cross;
  for (int i = 0; i < 3; ++i) cross.col(i) = axis.cross(Column3::Unit(i));
  return {matrix, deg_s * kDegree * cross * matrix};
}

Turn one_after(const Turn& a, const Turn& b) {
  return {a.matrix * b.matrix, a.rate * b.matrix + a.matrix * b.rate};
}

// Adds `vector` to the third column.
Matrix3 shifted(Matrix3 matrix, const Column3& vector) {
  matrix.col(2) += vector;
  return matrix;
}

}  // namespace

TableCamera::TableCamera(const Homography& home, const PinholeCamera& camera)
    : camera_(checked(camera)),
      camera_from_table_(projection_of(camera).inverse() * home.image_from_table()) {
  // The first two columns are the table's axes, unit vectors times the scale.
  scale_ = std::sqrt(camera_from_table_.col(0).norm() * camera_from_table_.col(1).norm());
}

std::optional<TableView> TableCamera::view_at(const HeadPose& pose) const {
  // Axes of the turned camera in the frame of the home pose: x right, y down, z forwards. The
  // rotation is intrinsic: each turn is about an axis of the camera as already turned.
  const Turn turn =
      one_after(one_after(turn_about(Column3::UnitY(), pose.yaw_deg, pose.yaw_deg_s),
                          turn_about(Column3::UnitX(), pose.pitch_deg, pose.pitch_deg_s)),
                turn_about(Column3::UnitZ(), pose.roll_deg, pose.roll_deg_s));
  // From the pivot, which stays, to a point of the table: at home, then turned, then from the
  // camera again.
  const Column3 pivot = scale_ * Column3(camera_.pivot_m.data());
  const Matrix3 from_pivot = shifted(camera_from_table_, -pivot);
  const Matrix3 projection = projection_of(camera_);
  const std::optional<Homography> homography =
      Homography::of_view(projection * shifted(turn.matrix.transpose() * from_pivot, pivot));
  if (!homography) return std::nullopt;
  const Matrix3 image_rate = projection * turn.rate.transpose() * from_pivot;
  // (G⁻¹)' = −G⁻¹ G' G⁻¹
  const Matrix3& inverse = homography->table_from_image();
  return TableView{*homography, -inverse * image_rate * inverse};
}

Homography TableCamera::raised(double height_m) const {
  // Up is the cross product of the table's axes: x forwards, y to the left.
  const Column3 up = camera_from_table_.col(0).cross(camera_from_table_.col(1));
  const auto homography = Homography::of_view(projection_of(camera_) *
                                              shifted(camera_from_table_, height_m / scale_ * up));
  if (!homography) {
    throw std::invalid_argument("the camera must not lie at the requested height");
  }
  return *homography;
}

}  // namespace puck
