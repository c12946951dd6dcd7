#include "services/camera/replay_controls.h"

#include <exception>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/messaging/conversions.h"

namespace puck {
namespace {

const char* why_not_taken(ControlGuard::Judgement judgement) {
  return judgement == ControlGuard::Judgement::kTooMany
             ? "refused: more than 20 controls a second"
             : "refused: for another camera, or an earlier session of this one";
}

}  // namespace

ReplayControls::ReplayControls(Replay* replay, ServiceContext& context)
    : replay_(replay), context_(context) {
  context_.bus.subscribe<CameraControl>(
      [this](const CameraControl& control, const Receipt& receipt) { hear(control, receipt); });
}

void ReplayControls::use_keys() {
  keys_.emplace();
  if (keys_->is_on()) context_.log.info("keys: space pauses, ? shows all");
}

void ReplayControls::poll() {
  if (replay_ == nullptr) return;
  while (const auto request = keys_ ? keys_->read() : std::nullopt) {
    const ControlVerdict verdict = obey(request);
    if (verdict == ControlVerdict::kSearching) search_session_ = 0;
    context_.log.info(outcome(verdict));
  }
  if (keys_ && keys_->was_help_asked()) context_.log.info(TerminalKeys::kHelp);
  show_state();
}

void ReplayControls::hear(const CameraControl& control, const Receipt& receipt) {
  const auto judgement = guard_.judge(control, context_.bus.session(), receipt.monotonic_us);
  if (judgement == ControlGuard::Judgement::kRepeat) return;
  const std::string sender = context_.peers.name_of(control.session);
  if (judgement != ControlGuard::Judgement::kTake) {
    context_.limited_log.warn("refused control",
                              fmt::format("{}: {}", sender, why_not_taken(judgement)));
    return;
  }
  const ControlVerdict verdict = obey(request_in(control));
  if (verdict == ControlVerdict::kSearching) search_session_ = control.session;
  guard_.answer(control.session, verdict);
  context_.limited_log.info("control", fmt::format("{}: {}", sender, outcome(verdict)));
  show_state();
}

ControlVerdict ReplayControls::obey(const std::optional<ReplayRequest>& request) {
  if (replay_ == nullptr) return ControlVerdict::kNoRecording;
  if (!request) return ControlVerdict::kInvalid;
  try {
    return replay_->obey(*request, Replay::Clock::now());
  } catch (const std::exception& error) {
    context_.limited_log.warn("unreadable", error.what());
    return ControlVerdict::kUnreadable;
  }
}

void ReplayControls::end_search(bool is_found) {
  const ControlVerdict verdict = is_found ? ControlVerdict::kObeyed : ControlVerdict::kBeyondEnd;
  if (const std::int64_t sender = std::exchange(search_session_, 0); sender != 0) {
    guard_.answer(sender, verdict);
  }
  if (!is_found) context_.limited_log.info("search", outcome(verdict));
  show_state();
}

std::string ReplayControls::outcome(ControlVerdict verdict) const {
  switch (verdict) {
    case ControlVerdict::kObeyed:
    case ControlVerdict::kSearching:
      return place();
    default:
      return std::string("refused: ") + to_string(verdict);
  }
}

std::string ReplayControls::place() const {
  const std::string position = seconds_text(replay_->position_us(Replay::Clock::now()));
  if (replay_->is_searching()) return "searching " + position;
  if (replay_->is_paused()) return "paused at " + position;
  if (replay_->speed() == 1) return "at " + position;
  return fmt::format("at {}, speed {:g}", position, replay_->speed());
}

void ReplayControls::show_state() {
  if (replay_ == nullptr || !replay_->is_controllable() || !replay_->is_begun()) return;
  const bool is_held = replay_->is_searching() || replay_->is_paused();
  // Until the next packet the state stays, but no longer its text.
  const bool was_held = std::exchange(shows_hold_, is_held);
  if (is_held || was_held) {
    context_.status.set_state(ServiceState::kWaiting, place());
  } else if (context_.status.state() == ServiceState::kRunning) {
    context_.status.set_state(ServiceState::kRunning, place());
  }
}

void ReplayControls::report(StatusReport& report) const {
  if (replay_ != nullptr) {
    const LatencySummary late = replay_->lateness();
    if (late.samples > 0) {
      report.latencies.push_back(
          {"behind_schedule", late.p50_us, late.p99_us, late.max_us, late.samples});
    }
    if (replay_->is_controllable()) {
      report.counters.emplace_back(kPositionUs, replay_->position_us(Replay::Clock::now()));
    }
  }
  report.add_unless_zero("controls_obeyed", guard_.obeyed());
  report.add_unless_zero("controls_refused", guard_.refused());
  if (guard_.answered_session() != 0) {
    report.counters.emplace_back(kControlSession, guard_.answered_session());
    report.counters.emplace_back(kControlVerdict, static_cast<std::int64_t>(guard_.verdict()));
  }
}

}  // namespace puck
