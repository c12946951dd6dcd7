#include "common/play/arm_watch.h"

namespace puck {
namespace {

constexpr std::int64_t kSilentUs = 500'000;
// An arm may follow another bridge's last command for this time after this bridge starts.
constexpr std::int64_t kOtherCommanderUs = 500'000;

}  // namespace

void ArmWatch::hear(const ArmState& state, const HostNow& now, const SenderClock& sender) {
  // An arm in a replayed log must not be answered instead of the real one.
  if (freshness_of(state.utime, now, sender, max_clock_error_us_) != Freshness::kOfNow) return;
  switch (publisher_.hear(state.session, state.seq, now.monotonic_us)) {
    case SinglePublisher::Verdict::kNewPublisher:
    case SinglePublisher::Verdict::kAccepted:
      if (!newest_ || newest_->command.session != state.command.session) {
        commander_since_us_ = now.monotonic_us;
      }
      newest_ = state;
      heard_us_ = now.monotonic_us;
      break;
    case SinglePublisher::Verdict::kLate:
    case SinglePublisher::Verdict::kOtherPublisher:
      break;
  }
}

const ArmState* ArmWatch::arm(const HostNow& now) const {
  return newest_ && now.monotonic_us - heard_us_ <= kSilentUs ? &*newest_ : nullptr;
}

std::int64_t ArmWatch::other_commander(std::int64_t own_session, const HostNow& now) const {
  const ArmState* heard = arm(now);
  if (heard == nullptr || heard->command.session == own_session) return 0;
  // A latched arm obeys no commands; `command` is that of the stop.
  if (heard->is_latched()) return 0;
  return now.monotonic_us - commander_since_us_ > kOtherCommanderUs ? heard->command.session : 0;
}

}  // namespace puck
