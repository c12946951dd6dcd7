#include "services/camera/truth_messages.h"

#include "common/messaging/conversions.h"

namespace puck {

ground_truth_t to_truth_message(const SimulatedTruth& truth, SensorSize sensor,
                                const PictureTurn& turn) {
  ground_truth_t message{};
  message.sensor_us = truth.time.us;
  const Pixel position = turn.apply(truth.position_px, sensor);
  message.x_px = position.x;
  message.y_px = position.y;
  message.width_px = truth.size_px.width;
  message.height_px = truth.size_px.height;
  message.visible = truth.visible;
  message.in_play = truth.in_play ? 1 : 0;
  message.x_m = truth.position.x_m;
  message.y_m = truth.position.y_m;
  message.vx_m_s = truth.velocity.x_m_s;
  message.vy_m_s = truth.velocity.y_m_s;
  message.shots = truth.counts.shots;
  message.saves = truth.counts.saves;
  message.goals_against = truth.counts.goals_against;
  message.goals_for = truth.counts.goals_for;
  return message;
}

head_state_t to_head_message(const SimulatedTruth& truth, const PictureTurn& turn) {
  HeadPose head = truth.head;
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
  return to_message(head, truth.time);
}

}  // namespace puck
