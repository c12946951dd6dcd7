#include "common/table/table_view.h"

namespace puck {

std::optional<PuckTrack> TableView::to_table(const ImageTrack& seen) const {
  const std::optional<TablePoint> point = homography_.to_table(seen.position);
  if (!point) return std::nullopt;
  // The point is h / w with (h, w) = H (u, v, 1); its velocity follows from h' = H' (u, v, 1) +
  // H (u', v', 0) and so on.
  const Matrix3& h = homography_.table_from_image();
  const Column3 pixel{seen.position.x, seen.position.y, 1};
  const Column3 motion{seen.velocity.x, seen.velocity.y, 0};
  const double w = product(h, pixel)[2];
  const Column3 turned = product(rate_, pixel);
  const Column3 moved = product(h, motion);
  const double w_rate = turned[2] + moved[2];
  const auto [x, y] = *point;
  const double vx = (turned[0] + moved[0] - x * w_rate) / w;
  const double vy = (turned[1] + moved[1] - y * w_rate) / w;

  // J = d(place)/d(pixel) is also d(velocity)/d(image velocity), and J' is d(velocity)/d(pixel).
  const auto [jxu, jxv, jyu, jyv] = homography_.jacobian_at(seen.position);
  const auto rate_of = [&](std::size_t row, std::size_t column, double place, double speed,
                           double slope) {
    return (rate_[3 * row + column] - speed * h[6 + column] - place * rate_[6 + column] -
            slope * w_rate) /
           w;
  };
  const double dxu = rate_of(0, 0, x, vx, jxu);
  const double dxv = rate_of(0, 1, x, vx, jxv);
  const double dyu = rate_of(1, 0, y, vy, jyu);
  const double dyv = rate_of(1, 1, y, vy, jyv);
  const Matrix4 slope{jxu, jxv, 0, 0, jyu, jyv, 0, 0, dxu, dxv, jxu, jxv, dyu, dyv, jyu, jyv};
  return PuckTrack{{*point, {vx, vy}}, symmetric_part(carried(slope, seen.covariance))};
}

}  // namespace puck
