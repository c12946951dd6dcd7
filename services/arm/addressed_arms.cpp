#include "services/arm/addressed_arms.h"

#include "common/messaging/message_facts.h"

namespace puck {
namespace {

// Of an ARM_STATE's utime, by its sender's clock: as the arm has it for commands.
constexpr std::int64_t kMaxClockErrorUs = 200'000;
// An arm says its state at least ten times a second.
constexpr std::int64_t kSilentUs = 250'000;

}  // namespace

void AddressedArms::hear(const arm_state_t& state, const HostNow& now, const SenderClock& sender) {
  const bool is_of_now =
      freshness_of(state.utime, now, sender, kMaxClockErrorUs) == Freshness::kOfNow;
  arms_[state.session] = {state, now.monotonic_us, is_of_now};
}

bool AddressedArms::confirms(const arm_state_t& state) const {
  if (mode_ == arm_command_t::MODE_RESET) return !is_latched(state);
  return is_latched(state) && state.command_session == own_session_;
}

// Nobody but an arm that heard this run's stop can name its session, whatever its clock.
bool AddressedArms::counts(const Arm& arm, const HostNow& now) const {
  if (now.monotonic_us - arm.heard_us > kSilentUs) return false;
  const bool answers_stop = mode_ == arm_command_t::MODE_STOP && confirms(arm.state);
  return arm.clock_is_good || answers_stop;
}

std::vector<std::int64_t> AddressedArms::sessions(const HostNow& now) const {
  std::vector<std::int64_t> sessions;
  for (const auto& [session, arm] : arms_) {
    if (counts(arm, now)) sessions.push_back(session);
  }
  return sessions;
}

std::string AddressedArms::why_not(const HostNow& now) const {
  bool is_there_one = false;
  for (const auto& [session, arm] : arms_) {
    if (!counts(arm, now)) continue;
    is_there_one = true;
    if (confirms(arm.state)) continue;
    const std::string says = arm.state.reason.empty() ? "that it moves" : arm.state.reason;
    return "the arm of session " + std::to_string(session) + " says: " + says;
  }
  if (is_there_one) return {};
  return arms_.empty() ? "no ARM_STATE heard" : "no ARM_STATE that is of now";
}

}  // namespace puck
