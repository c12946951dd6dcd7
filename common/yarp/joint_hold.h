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

/// Which modes a board's joints are in, and ours for as long as we hold them. Joints are taken from
/// the modes `pos` and `posd` only: a joint in any other is being calibrated, is driven by somebody
/// else, or has its motor off, and is left to the robot's own tools. One thread.
///
/// What goes wrong throws BoardError: a joint that is in none of these modes is not ready, one in a
/// hardware fault needs a person.
class JointHold {
 public:
  enum class State : std::uint8_t {
    kNone,    ///< The modes are only looked at.
    kAsking,  ///< The next look that begins decides whether the joints are taken.
    kTaking,  ///< They are put into `posd`, one after the other.
    kTaken,   ///< They are in it.
  };

  /// Asks for the modes. All must outlive it.
  JointHold(const YarpParams& params, const BoardJoints& joints, BoardRequests& requests);

  State state() const { return state_; }
  /// When they came into our hands; there must have been such a time.
  SteadyClock::time_point taken_at() const { return taken_at_; }

  void begin_to_take();
  /// Goes on with what has to be asked, and heeds what was answered: whether anything was. Joints
  /// that nobody `wants` any more while they are being taken are not.
  bool attend(bool wants);
  /// When to attend next, though no answer has come.
  Deadline next_at() const;

  /// Leaves the joints that it has taken where they are, in mode `pos`, within 50 ms; not those
  /// that something else has put into another mode since.
  void leave();

 private:
  void heed(const BoardAnswer& answer);
  void heed_modes(const std::vector<std::string>& modes);
  void check_ready(const std::vector<std::string>& modes) const;
  std::string wrong_mode(const std::vector<std::string>& modes) const;

  const YarpParams& params_;
  const BoardJoints& joints_;
  BoardRequests& requests_;
  State state_ = State::kNone;
  bool was_asked_before_ = false;  // the question under way, before the joints were wanted
  bool was_withdrawn_ = false;  // nobody has wanted them at some time since that was last looked at
  bool has_put_ = false;        // any joint into `posd`
  std::size_t joints_put_ = 0;  // by what the board answered
  Deadline next_look_at_;
  Deadline taken_by_;
  SteadyClock::time_point taken_at_;
};

}  // namespace puck
