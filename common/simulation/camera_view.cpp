#include "common/simulation/camera_view.h"

#include <cmath>
#include <numbers>

namespace puck {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kNearest_m = 0.01;

using Matrix = std::array<double, 9>;

Matrix adjugate_of(const Matrix& h) {
  return {h[4] * h[8] - h[5] * h[7], h[2] * h[7] - h[1] * h[8], h[1] * h[5] - h[2] * h[4],
          h[5] * h[6] - h[3] * h[8], h[0] * h[8] - h[2] * h[6], h[2] * h[3] - h[0] * h[5],
          h[3] * h[7] - h[4] * h[6], h[1] * h[6] - h[0] * h[7], h[0] * h[4] - h[1] * h[3]};
}

}  // namespace

CameraView::CameraView(const CameraParams& params, SensorSize size)
    : centre_{-params.behind_m, 0, params.height_m},
      right_{0, -1, 0},
      down_{-std::sin(params.pitch_deg * kDegree), 0, -std::cos(params.pitch_deg * kDegree)},
      forward_{std::cos(params.pitch_deg * kDegree), 0, -std::sin(params.pitch_deg * kDegree)},
      size_(size),
      focal_px_(params.focal_px),
      principal_point_{(size.width - 1) / 2.0, (size.height - 1) / 2.0} {}

CameraView CameraView::turned(const HeadPose& pose) const {
  const double cy = std::cos(pose.yaw_deg * kDegree), sy = std::sin(pose.yaw_deg * kDegree);
  const double cp = std::cos(pose.pitch_deg * kDegree), sp = std::sin(pose.pitch_deg * kDegree);
  const double cr = std::cos(pose.roll_deg * kDegree), sr = std::sin(pose.roll_deg * kDegree);

  // Intrinsic rotation: each turn is about an axis of the camera as already turned.
  const Vector3 yawed_right = cy * right_ - sy * forward_;
  const Vector3 yawed_forward = sy * right_ + cy * forward_;
  const Vector3 pitched_down = cp * down_ + sp * yawed_forward;

  CameraView view = *this;
  view.forward_ = cp * yawed_forward - sp * down_;
  view.right_ = cr * yawed_right + sr * pitched_down;
  view.down_ = cr * pitched_down - sr * yawed_right;
  return view;
}

Vector3 CameraView::ray(Pixel pixel) const {
  return forward_ + ((pixel.x - principal_point_.x) / focal_px_) * right_ +
         ((pixel.y - principal_point_.y) / focal_px_) * down_;
}

std::optional<CameraView::Projection> CameraView::project(Vector3 point) const {
  const Vector3 offset = point - centre_;
  const double depth_m = dot(offset, forward_);
  if (!(depth_m > kNearest_m)) return std::nullopt;
  const double scale = focal_px_ / depth_m;
  return Projection{{principal_point_.x + scale * dot(offset, right_),
                     principal_point_.y + scale * dot(offset, down_)},
                    depth_m};
}

std::array<double, 9> CameraView::image_from_plane(double height_m) const {
  // Columns: the images of the plane's x axis, y axis and origin.
  const Vector3 origin = Vector3{0, 0, height_m} - centre_;
  const auto u = [&](Vector3 v) {
    return focal_px_ * dot(v, right_) + principal_point_.x * dot(v, forward_);
  };
  const auto v = [&](Vector3 w) {
    return focal_px_ * dot(w, down_) + principal_point_.y * dot(w, forward_);
  };
  const Vector3 x{1, 0, 0}, y{0, 1, 0};
  return {u(x),
          u(y),
          u(origin),
          v(x),
          v(y),
          v(origin),
          dot(x, forward_),
          dot(y, forward_),
          dot(origin, forward_)};
}

Homography CameraView::table_from_image(double height_m) const {
  Matrix inverse = adjugate_of(image_from_plane(height_m));
  for (double& coefficient : inverse) coefficient /= inverse[8] != 0 ? inverse[8] : 1;
  return Homography(inverse);
}

}  // namespace puck
