#include "common/messaging/conversions.h"

#include <algorithm>

namespace puck {
namespace {

bool has(const puck_estimate_t& message, std::int32_t flag) { return (message.flags & flag) != 0; }

}  // namespace

puck_estimate_t to_message(const PuckEstimate& estimate, SensorSize sensor) {
  puck_estimate_t message{};
  message.sensor_us = estimate.newest_event.us;
  message.events_applied = estimate.events_applied;
  message.state = static_cast<std::int8_t>(estimate.state);
  if (estimate.resting) message.flags |= puck_estimate_t::FLAG_RESTING;
  if (estimate.coasting) message.flags |= puck_estimate_t::FLAG_COASTING;
  if (estimate.left_image) {
    message.flags |= puck_estimate_t::FLAG_LEFT_IMAGE;
    message.left_x_px = estimate.left_image->x;
    message.left_y_px = estimate.left_image->y;
  }
  if (estimate.position) {
    message.flags |= puck_estimate_t::FLAG_POSITION;
    message.x_px = estimate.position->x;
    message.y_px = estimate.position->y;
    message.vx_px_s = estimate.velocity.x;
    message.vy_px_s = estimate.velocity.y;
    message.width_px = estimate.size.width;
    message.height_px = estimate.size.height;
    std::copy(estimate.covariance.begin(), estimate.covariance.end(), message.covariance);
  }
  message.score = estimate.score;
  message.region_x = estimate.region.x;
  message.region_y = estimate.region.y;
  message.region_width = std::max(estimate.region.width, 0);
  message.region_height = std::max(estimate.region.height, 0);
  message.image_width = sensor.width;
  message.image_height = sensor.height;
  return message;
}

PuckEstimate from_message(const puck_estimate_t& message) {
  PuckEstimate estimate;
  estimate.newest_event = Timestamp{message.sensor_us};
  estimate.events_applied = message.events_applied;
  estimate.state = static_cast<TrackState>(message.state);
  estimate.resting = has(message, puck_estimate_t::FLAG_RESTING);
  estimate.coasting = has(message, puck_estimate_t::FLAG_COASTING);
  if (has(message, puck_estimate_t::FLAG_LEFT_IMAGE)) {
    estimate.left_image = Pixel{message.left_x_px, message.left_y_px};
  }
  if (has(message, puck_estimate_t::FLAG_POSITION)) {
    estimate.position = Pixel{message.x_px, message.y_px};
    estimate.velocity = {message.vx_px_s, message.vy_px_s};
    estimate.size = {message.width_px, message.height_px};
    std::copy(std::begin(message.covariance), std::end(message.covariance),
              estimate.covariance.begin());
  }
  estimate.score = message.score;
  estimate.region = {message.region_x, message.region_y, message.region_width,
                     message.region_height};
  return estimate;
}

TruthRow from_message(const ground_truth_t& message) {
  return {{message.sensor_us},
          {message.x_px, message.y_px},
          {message.width_px, message.height_px},
          message.visible};
}

head_state_t to_message(const HeadPose& pose, Timestamp at) {
  head_state_t message{};
  message.sensor_us = at.us;
  message.yaw_deg = pose.yaw_deg;
  message.pitch_deg = pose.pitch_deg;
  message.roll_deg = pose.roll_deg;
  message.yaw_deg_s = pose.yaw_deg_s;
  message.pitch_deg_s = pose.pitch_deg_s;
  message.roll_deg_s = pose.roll_deg_s;
  return message;
}

HeadPose from_message(const head_state_t& message) {
  return {message.yaw_deg,   message.pitch_deg,   message.roll_deg,
          message.yaw_deg_s, message.pitch_deg_s, message.roll_deg_s};
}

}  // namespace puck
