#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/yarp/board_joints.h"
#include "common/yarp/board_requests.h"
#include "common/yarp/waiter.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// Monitors the modes of a board's joints, and takes the joints. It takes joints from the modes
/// `pos` and `posd` only: a joint in any other mode is being calibrated, driven by another program,
/// or has its motor off, and is left to the robot's own tools. One thread.
///
/// Errors throw YarpError: a joint in none of these modes is not ready, one in a hardware fault
/// needs a person.
class JointHold {
 public:
  enum class State : std::uint8_t {
    kNone,    ///< Only monitors the modes.
    kAsking,  ///< The next query of the modes decides whether to take the joints.
    kTaking,  ///< Puts the joints into `posd`, one after the other.
    kTaken,   ///< The joints are in `posd`.
  };

  /// Queries the modes. The arguments must outlive this object.
  JointHold(const YarpParams& params, const BoardJoints& joints, BoardRequests& requests);

  State state() const { return state_; }
  /// Time at which the joints were taken; only after that.
  SteadyClock::time_point taken_at() const { return taken_at_; }

  void begin_to_take();
  /// Continues the requests and processes an answer; returns whether there was one. Taking stops
  /// when the joints are no longer wanted (`wants` is false).
  bool attend(bool wants);
  /// Latest time of the next `attend`, if no answer comes before.
  Deadline next_at() const;

  /// Puts the joints that it has taken into mode `pos`, within 50 ms; except joints that another
  /// program has put into another mode since.
  void leave();

 private:
  void process_answer(const BoardAnswer& answer);
  void process_modes(const std::vector<std::string>& modes);
  void check_ready(const std::vector<std::string>& modes) const;
  std::string wrong_mode(const std::vector<std::string>& modes) const;

  const YarpParams& params_;
  const BoardJoints& joints_;
  BoardRequests& requests_;
  State state_ = State::kNone;
  bool was_asked_before_ = false;  // The pending query started before begin_to_take().
  bool was_withdrawn_ = false;     // `wants` was false at some time since the last check.
  bool has_put_ = false;           // At least one joint into `posd`.
  std::size_t joints_put_ = 0;     // According to the answers.
  Deadline next_look_at_;
  Deadline taken_by_;
  SteadyClock::time_point taken_at_;
};

}  // namespace puck
