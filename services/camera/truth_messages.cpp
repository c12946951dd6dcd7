#include "services/camera/truth_messages.h"

#include "common/messaging/conversions.h"

namespace puck {

ground_truth_t to_truth_message(const SimulatedTruth& truth, SensorSize sensor, bool rotated_180) {
  ground_truth_t message{};
  message.sensor_us = truth.time.us;
  message.x_px = rotated_180 ? sensor.width - 1 - truth.position_px.x : truth.position_px.x;
  message.y_px = rotated_180 ? sensor.height - 1 - truth.position_px.y : truth.position_px.y;
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

head_state_t to_head_message(const SimulatedTruth& truth, bool rotated_180) {
  HeadPose head = truth.head;
  if (rotated_180) {
    // A half turn about the optical axis reverses left and right, up and down.
    for (double* angle : {&head.yaw_deg, &head.pitch_deg, &head.yaw_deg_s, &head.pitch_deg_s}) {
      *angle = -*angle;
    }
  }
  return to_message(head, truth.time);
}

}  // namespace puck
