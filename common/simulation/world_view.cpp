#include "common/simulation/world_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace puck {
namespace {

constexpr double kKnobRadius_m = 0.02;
constexpr double kKnobTop_m = 0.075;
constexpr double kHandRadius_m = 0.03;
constexpr double kHandHeight_m = 0.07;
constexpr double kElbowRadius_m = 0.035;
// The free hand with its fingers spread.
constexpr double kReachingRadius_m = 0.05;
constexpr Vector3 kReachingElbow{0.35, -0.08, 0.12};

bool is_above_table(WorldView::Body which) {
  return which == WorldView::kRobotArm || which == WorldView::kOpponentArm ||
         which == WorldView::kFreeHand;
}

}  // namespace

WorldView::WorldView(const TableGeometry& table, const SceneParams& scene, SensorSize size)
    : table_(table), scene_(scene), size_(size) {}

ProjectedCylinder WorldView::puck_shape(TablePoint puck, const CameraView& view) const {
  return {view, puck, table_.puck_radius_m, 0, scene_.puck_height_m};
}

SceneBody WorldView::body(Body which, const TableGame& game, const CameraView& view) const {
  const auto place = place_of(which, game);
  if (!place) return {};
  if (which == kPuck || which == kSecondPuck) return puck_body(*place, view);
  if (which == kRobot || which == kOpponent) return mallet_body(*place, view);
  if (which != kFreeHand) return arm_body(which, *place, view);
  const Vector3 hand = *game.free_hand().place();
  SceneBody body;
  body.shapes.push_back(
      {ProjectedCapsule(view, hand, kReachingRadius_m, hand + kReachingElbow, kReachingRadius_m),
       static_cast<float>(scene_.skin_luminance)});
  return body;
}

SceneBody WorldView::puck_body(TablePoint puck, const CameraView& view) const {
  SceneBody body;
  // From the inside out: each shape contains the previous ones.
  const auto add = [&](ProjectedCylinder shape, double luminance) {
    body.shapes.push_back({std::move(shape), static_cast<float>(luminance), !body.shapes.empty()});
  };
  const auto disc_on_top = [&](double radius_m) {
    return ProjectedCylinder(view, puck, radius_m, scene_.puck_height_m, scene_.puck_height_m);
  };
  const double top = scene_.puck_luminance;
  if (scene_.puck_print_luminance > 0) {
    const double half_width_m = scene_.puck_print_width_m / 2;
    add(disc_on_top(scene_.puck_print_radius_m - half_width_m), top);
    add(disc_on_top(scene_.puck_print_radius_m + half_width_m), scene_.puck_print_luminance);
  }
  const double side = scene_.puck_side_luminance > 0 ? scene_.puck_side_luminance : top;
  if (side != top) add(disc_on_top(table_.puck_radius_m), top);
  add(puck_shape(puck, view), side);
  return body;
}

SceneBody WorldView::mallet_body(TablePoint mallet, const CameraView& view) const {
  SceneBody body;
  body.shapes.push_back(
      {ProjectedCylinder(view, mallet, table_.mallet_radius_m, 0, scene_.mallet_height_m),
       static_cast<float>(scene_.mallet_luminance)});
  return body;
}

SceneBody WorldView::arm_body(Body which, TablePoint mallet, const CameraView& view) const {
  SceneBody body;
  // The robot's elbow is above the near end, the opponent's beyond the far rail.
  const bool is_robots = which == kRobotArm;
  const Vector3 elbow = is_robots ? Vector3{mallet.x_m - 0.35, 0.5 * mallet.y_m - 0.15, 0.22}
                                  : Vector3{mallet.x_m + 0.32, mallet.y_m + 0.12, 0.2};
  body.shapes.push_back(
      {ProjectedCapsule(view, {mallet.x_m, mallet.y_m, kHandHeight_m}, kHandRadius_m, elbow,
                        kElbowRadius_m),
       static_cast<float>(is_robots ? scene_.robot_luminance : scene_.skin_luminance)});
  body.shapes.push_back(
      {ProjectedCylinder(view, mallet, kKnobRadius_m, scene_.mallet_height_m, kKnobTop_m),
       static_cast<float>(scene_.mallet_luminance * 1.5)});
  return body;
}

std::optional<TablePoint> WorldView::place_of(Body which, const TableGame& game) {
  switch (which) {
    case kRobot:
    case kRobotArm:
      return game.robot_mallet().position;
    case kOpponent:
    case kOpponentArm:
      return game.opponent_mallet().position;
    case kFreeHand:
      if (!game.free_hand().place()) return std::nullopt;
      return TablePoint{game.free_hand().place()->x, game.free_hand().place()->y};
    case kSecondPuck:
      if (!game.second_puck()) return std::nullopt;
      return game.second_puck()->state().position;
    case kPuck:
    case kBodyCount:
      break;
  }
  if (!game.puck()) return std::nullopt;
  return game.puck()->position;
}

std::vector<int> WorldView::nearest_first(const TableGame& game) {
  std::vector<int> order(kBodyCount);
  std::iota(order.begin(), order.end(), 0);
  const auto rank = [&](int index) {
    const Body which = static_cast<Body>(index);
    const auto place = place_of(which, game);
    return std::pair(!is_above_table(which), place ? place->x_m : 0);
  };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return rank(a) < rank(b); });
  return order;
}

PixelBox WorldView::puck_box(TablePoint puck, const CameraView& view) const {
  return puck_shape(puck, view).box();
}

double WorldView::visible_share(const TableGame& game, const CameraView& view) const {
  constexpr int kSamples = 12;  // Samples along each side of the puck's box.
  if (!game.puck()) return 0;
  const ProjectedCylinder puck = puck_shape(game.puck()->position, view);
  std::vector<SceneShape> covers;
  for (const int nearer : nearest_first(game)) {
    if (nearer == kPuck) break;
    for (SceneShape& shape : body(static_cast<Body>(nearer), game, view).shapes) {
      covers.push_back(std::move(shape));
    }
  }
  const PixelBox box = puck.box();
  const Region image = Region::all_of(size_);

  double all = 0;
  double seen = 0;
  for (int i = 0; i < kSamples * kSamples; ++i) {
    const double sx = (i % kSamples + 0.5) / kSamples - 0.5;
    const double sy = (i / kSamples + 0.5) / kSamples - 0.5;
    const int x = static_cast<int>(std::lround(box.centre.x + sx * box.size.width));
    const int y = static_cast<int>(std::lround(box.centre.y + sy * box.size.height));
    float share = 0;
    puck.coverage(y, x, 1, &share);
    all += share;
    if (!image.contains(x, y)) continue;
    float uncovered = share;
    for (const SceneShape& cover : covers) {
      float covered = 0;
      cover.coverage(y, x, 1, &covered);
      uncovered *= 1 - covered;
    }
    seen += uncovered;
  }
  return all > 0 ? seen / all : 0;
}

}  // namespace puck
