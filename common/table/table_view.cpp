#include "common/table/table_view.h"

namespace puck {

std::optional<PuckTrack> TableView::to_table(const ImageTrack& seen) const {
  const std::optional<TablePoint> point = homography_.to_table(seen.position);
  if (!point) return std::nullopt;
  // The point is h / w with (h, w) = H (u, v, 1); its velocity follows from h' = H' (u, v, 1) +
  // H (u', v', 0) and so on.
  const Matrix3& h = homography_.table_from_image();
  const Column3 pixel(seen.position.x, seen.position.y, 1);
  const double w = h.row(2) * pixel;
  const Column3 rate = rate_ * pixel + h * Column3(seen.velocity.x, seen.velocity.y, 0);
  const Eigen::Vector2d place(point->x_m, point->y_m);
  const Eigen::Vector2d speed = (rate.head<2>() - place * rate.z()) / w;

  // J = d(place)/d(pixel) is also d(velocity)/d(image velocity), and J' is d(velocity)/d(pixel).
  const Matrix2 jacobian = homography_.jacobian_at(seen.position);
  Matrix4 slope = Matrix4::Zero();
  slope.topLeftCorner<2, 2>() = jacobian;
  slope.bottomRightCorner<2, 2>() = jacobian;
  slope.bottomLeftCorner<2, 2>() =
      (rate_.topLeftCorner<2, 2>() - speed * h.bottomLeftCorner<1, 2>() -
       place * rate_.bottomLeftCorner<1, 2>() - jacobian * rate.z()) /
      w;
  return PuckTrack{{*point, {speed.x(), speed.y()}},
                   symmetric_part(carried(slope, seen.covariance))};
}

}  // namespace puck
