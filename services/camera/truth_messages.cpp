#include "services/camera/truth_messages.h"

namespace puck {

GroundTruth to_truth_message(const SimulatedTruth& truth, SensorSize sensor,
                             const PictureTurn& turn) {
  return {{},
          {truth.time, turn.apply(truth.position_px, sensor), truth.size_px, truth.visible},
          truth.in_play,
          {truth.position, truth.velocity},
          truth.counts.shots,
          truth.counts.saves,
          truth.counts.goals_against,
          truth.counts.goals_for};
}

HeadState to_head_message(const SimulatedTruth& truth, const PictureTurn& turn) {
  HeadState head{{}, truth.head, truth.time};
  const bool is_half_turned = turn.rotate_deg == 180;
  const auto negate = [](double& angle, double& speed) {
    angle = -angle;
    speed = -speed;
  };
  const bool mirrors_x = turn.flip_x != is_half_turned;
  const bool mirrors_y = turn.flip_y != is_half_turned;
  if (mirrors_x) negate(head.yaw_deg, head.yaw_deg_s);
  if (mirrors_y) negate(head.pitch_deg, head.pitch_deg_s);
  // A single mirror also reverses clockwise.
  if (mirrors_x != mirrors_y) negate(head.roll_deg, head.roll_deg_s);
  return head;
}

}  // namespace puck
