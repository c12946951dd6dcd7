#include "services/arm/addressed_arms.h"

namespace puck {
namespace {

// Limit for the age of an ARM_STATE, as the arm's for commands.
constexpr std::int64_t kMaxClockErrorUs = 200'000;
// An arm publishes its state at least ten times a second.
constexpr std::int64_t kSilentUs = 250'000;

}  // namespace

void AddressedArms::hear(const ArmState& state, const HostNow& now, const SenderClock& sender) {
  const Freshness freshness = freshness_of(state.utime, now, sender, kMaxClockErrorUs);
  arms_[state.session] = {state, now.monotonic_us, freshness};
}

bool AddressedArms::confirms(const ArmState& state) const {
  if (mode_ == CommandMode::kReset) return !state.is_latched();
  return state.is_latched() && state.command.session == own_session_;
}

// Only an arm that heard this run's stop can name its session; its clock does not matter.
bool AddressedArms::is_certain(const Arm& arm) const {
  const bool answers_stop = mode_ == CommandMode::kStop && confirms(arm.state);
  return arm.freshness == Freshness::kOfNow || answers_stop;
}

// An arm of unknown clock may be a real one, and moving.
bool AddressedArms::is_heard(const Arm& arm, const HostNow& now) const {
  if (now.monotonic_us - arm.heard_us > kSilentUs) return false;
  return arm.freshness == Freshness::kClockUnknown || is_certain(arm);
}

std::vector<std::int64_t> AddressedArms::sessions(const HostNow& now) const {
  std::vector<std::int64_t> sessions;
  for (const auto& [session, arm] : arms_) {
    if (is_heard(arm, now) && is_certain(arm)) sessions.push_back(session);
  }
  return sessions;
}

std::string AddressedArms::why_not(const HostNow& now) const {
  bool is_there_one = false;
  for (const auto& [session, arm] : arms_) {
    if (!is_heard(arm, now)) continue;
    is_there_one = is_there_one || is_certain(arm);
    if (confirms(arm.state)) continue;
    const std::string says = arm.state.reason.empty() ? "that it moves" : arm.state.reason;
    return "the arm of session " + std::to_string(session) +
           (is_certain(arm) ? "" : ", whose clock is not known,") + " says: " + says;
  }
  if (is_there_one) return {};
  return arms_.empty() ? "no ARM_STATE heard" : "no current ARM_STATE";
}

}  // namespace puck
