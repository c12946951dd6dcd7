#pragma once

#include <cstdint>

#include "common/messages/message_header.h"

namespace puck {

/// As CAMERA_CONTROL numbers them. A control that was not checked may hold another number.
enum class CameraControlMode : std::int8_t {
  kPause,   ///< Publish nothing until a resume or a step.
  kResume,  ///< Play on.
  kStep,    ///< Play `step_us` on, then pause.
  kSeek,    ///< Go to `position_us` and begin a new session.
  kSpeed,   ///< Play at `speed` from now on.
};

/// CAMERA_CONTROL: what a camera that plays a recording is to do.
struct CameraControl : MessageHeader {
  CameraControlMode mode = CameraControlMode::kPause;
  std::int64_t camera_session = 0;  ///< Of the camera's newest STATUS.
  std::int64_t request = 0;         ///< Number in this session; repeats have the same one.
  std::int64_t position_us = 0;     ///< Of a seek: sensor time since the first event.
  std::int64_t step_us = 0;         ///< Of a step: sensor time; 0: as the camera is set.
  double speed = 0;                 ///< Of a speed: sensor time per host time.
};

}  // namespace puck
