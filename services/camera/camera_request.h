#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "common/messages/camera_control.h"
#include "common/messages/host_now.h"
#include "services/camera/control_verdict.h"
#include "services/launch/operator_request.h"

namespace puck {

/// A control for every camera on the bus, and their answers in STATUS. A camera counts while it is
/// heard, its clock is known and its STATUS is current: one in a replayed log never does. Cameras
/// without a recording are not asked, and do not matter beside one that obeys.
class CameraRequest final : public OperatorRequest {
 public:
  /// The control is sent with a session, a request number and, `is_relative`, a position counted
  /// from where the camera is. `goal`: the state that it asks for.
  CameraRequest(const CameraControl& control, bool is_relative, std::string goal)
      : control_(control), is_relative_(is_relative), goal_(std::move(goal)) {}

  void listen(Bus& bus, StatusReporter& status) override;
  bool publish(Bus& bus) override;
  std::string why_not() const override;
  std::string refusal() const override;
  bool is_in_progress() const override;
  std::string goal() const override { return goal_; }
  std::string result() const override;

 private:
  struct Camera {
    std::string name;          // For people.
    std::string state;         // As in its STATUS, for people.
    std::int64_t session = 0;  // Changes with a seek that is obeyed.
    std::int64_t first_heard_us = 0;
    std::int64_t heard_us = 0;
    std::int64_t target_us = -1;  // Of a seek; below 0: not sent yet.
    std::int64_t position_us = 0;
    bool has_answered = false;
    ControlVerdict verdict = ControlVerdict::kSearching;

    bool is(ControlVerdict answer) const { return has_answered && verdict == answer; }
  };

  void hear(const PeerStatus& status, const HostNow& now, bool is_current);
  static bool speaks(const Camera& camera, const HostNow& now);
  std::string list(ControlVerdict verdict) const;
  std::string but_obeyed() const;

  CameraControl control_;
  bool is_relative_;
  std::string goal_;
  std::int64_t own_session_ = 0;
  std::map<std::string, Camera> cameras_;  // By host and process.
};

}  // namespace puck
