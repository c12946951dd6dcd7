#include "common/yarp/joint_hold.h"

#include <chrono>
#include <utility>

#include "common/yarp/yarp_error.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

constexpr const char* kDirect = "posd";
constexpr const char* kPosition = "pos";
// Some boards change a joint's mode slowly.
constexpr milliseconds kModesTimeout{2000};
constexpr milliseconds kModesPeriod{10};
constexpr milliseconds kLeaveTimeout{50};

bool may_be_taken(const std::string& mode) { return mode == kPosition || mode == kDirect; }
// Emergency stop or hardware fault: `hwf` or `hwfa`.
bool is_hardware_fault(const std::string& mode) { return mode.starts_with("hwf"); }
bool is_motor_off(const std::string& mode) { return mode.starts_with("idl"); }

}  // namespace

JointHold::JointHold(const YarpParams& params, const BoardJoints& joints, BoardRequests& requests)
    : params_(params), joints_(joints), requests_(requests) {
  check_ready(requests_.modes(joints_.axes));
  next_look_at_ = SteadyClock::now() + milliseconds(params_.check_modes_ms);
}

void JointHold::check_ready(const std::vector<std::string>& modes) const {
  for (std::size_t i = 0; i < params_.joints.size(); ++i) {
    const std::string& mode = modes[static_cast<std::size_t>(params_.joints[i])];
    if (may_be_taken(mode)) continue;
    if (is_hardware_fault(mode)) {
      throw YarpError(joints_.names[i] + " is in mode " + in_quotes(mode) +
                          ", a hardware fault: bring it back into mode " + in_quotes(kPosition) +
                          " with the robot's own tools, then puck-arm --reset",
                      YarpError::Kind::kNeedsPerson);
    }
    throw YarpError(joints_.names[i] + " is not ready yet: it is in mode " + in_quotes(mode) +
                        (is_motor_off(mode) ? ", its motor off: the robot's own tools bring it "
                                              "into mode " +
                                                  in_quotes(kPosition)
                                            : std::string{}),
                    YarpError::Kind::kNotReady);
  }
}

std::string JointHold::wrong_mode(const std::vector<std::string>& modes) const {
  for (std::size_t i = 0; i < params_.joints.size(); ++i) {
    const std::string& mode = modes[static_cast<std::size_t>(params_.joints[i])];
    if (mode == kDirect) continue;
    return joints_.names[i] + " is in mode " + in_quotes(mode) + ", not in " + in_quotes(kDirect);
  }
  return {};
}

void JointHold::begin_to_take() {
  state_ = State::kAsking;
  was_asked_before_ = requests_.is_waiting();
  was_withdrawn_ = false;
  next_look_at_ = SteadyClock::now();
}

bool JointHold::attend(bool wants) {
  if (!wants) was_withdrawn_ = true;
  const auto answer = requests_.answer_now();
  if (answer) process_answer(*answer);
  const Deadline now = SteadyClock::now();
  if (requests_.is_waiting()) {
    if (now <= requests_.late_at()) return false;
    throw YarpError("no answer in time, asked " + in_quotes(requests_.asked()));
  }
  // A later request for the joints starts from the beginning.
  if (std::exchange(was_withdrawn_, false) &&
      (state_ == State::kAsking || state_ == State::kTaking)) {
    state_ = State::kNone;
  }
  if (state_ == State::kTaking && joints_put_ < params_.joints.size()) {
    has_put_ = true;
    requests_.begin_set_mode(params_.joints[joints_put_], kDirect);
  } else if (now >= next_look_at_) {
    next_look_at_ =
        now + (state_ == State::kTaking ? kModesPeriod : milliseconds(params_.check_modes_ms));
    requests_.begin_modes();
  }
  return answer.has_value();
}

// The state identifies the request: there is only one at a time.
void JointHold::process_answer(const BoardAnswer& answer) {
  if (state_ == State::kTaking && joints_put_ < params_.joints.size()) {
    ++joints_put_;
  } else {
    process_modes(answer.vocabs("cmds", joints_.axes));
  }
}

void JointHold::process_modes(const std::vector<std::string>& modes) {
  const bool is_outdated = std::exchange(was_asked_before_, false);
  if (state_ == State::kNone || state_ == State::kAsking) {
    check_ready(modes);
    if (state_ == State::kNone || is_outdated) return;
    state_ = State::kTaking;
    joints_put_ = 0;
    taken_by_ = SteadyClock::now() + kModesTimeout;
    next_look_at_ = SteadyClock::now();
    return;
  }
  const std::string wrong = wrong_mode(modes);
  if (wrong.empty()) {
    if (state_ == State::kTaking) taken_at_ = SteadyClock::now();
    state_ = State::kTaken;
  } else if (state_ == State::kTaken || SteadyClock::now() >= taken_by_) {
    throw YarpError(wrong);
  }
}

Deadline JointHold::next_at() const {
  return requests_.is_waiting() ? requests_.late_at() : next_look_at_;
}

void JointHold::leave() {
  if (!has_put_) return;
  // This session's own waiter is stopped.
  Waker waker;
  const Waiter waiter({}, waker);
  requests_.leave_mode(params_.joints, joints_.axes, kDirect, kPosition, waiter,
                       SteadyClock::now() + kLeaveTimeout);
}

}  // namespace puck
