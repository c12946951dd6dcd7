#include "services/camera/replay_controls.h"

#include <exception>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/messaging/conversions.h"

namespace puck {
namespace {

const char* why_not_taken(ControlGuard::Judgement judgement) {
  switch (judgement) {
    case ControlGuard::Judgement::kOld:
      return "refused: it was published more than 200 ms ago, as those in a log";
    case ControlGuard::Judgement::kFromFuture:
      return "refused: it is stamped with a later time than its sender's clock shows";
    case ControlGuard::Judgement::kClockUnknown:
      return "refused: its age is not known, because the sender's STATUS was not heard";
    case ControlGuard::Judgement::kTooMany:
      return "refused: more than 20 controls a second";
    default:
      return "";
  }
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

void ReplayControls::poll(bool has_ended) {
  if (replay_ == nullptr) return;
  while (const auto request = keys_ ? keys_->read() : std::nullopt) {
    const ControlVerdict verdict = obey(request, kKey);
    tells_step_ = request->kind == ReplayRequest::Kind::kStep && verdict == ControlVerdict::kObeyed;
    if (!tells_step_) context_.log.info(outcome(verdict));
  }
  if (tells_step_ && (has_ended || !replay_->is_stepping())) {
    tells_step_ = false;
    context_.log.info(place());
  }
  if (keys_ && keys_->was_help_asked()) context_.log.info(TerminalKeys::kHelp);
}

void ReplayControls::hear(const CameraControl& control, const Receipt& receipt) {
  using Judgement = ControlGuard::Judgement;
  const Judgement judgement =
      guard_.judge(control, context_.bus.session(), {receipt.utime, receipt.monotonic_us},
                   context_.status.clock_of(control.session));
  if (judgement == Judgement::kRepeat || judgement == Judgement::kOtherCamera) return;
  const std::string sender = context_.peers.name_of(control.session);
  if (judgement != Judgement::kTake) {
    context_.limited_log.warn("refused control",
                              fmt::format("{}: {}", sender, why_not_taken(judgement)));
    return;
  }
  const ControlVerdict verdict = obey(request_in(control), control.session);
  guard_.answer(control.session, verdict);
  context_.limited_log.info("control", fmt::format("{}: {}", sender, outcome(verdict)));
}

ControlVerdict ReplayControls::obey(const std::optional<ReplayRequest>& request,
                                    std::int64_t sender) {
  if (replay_ == nullptr) return ControlVerdict::kNoRecording;
  if (!request) return ControlVerdict::kInvalid;
  ControlVerdict verdict = ControlVerdict::kUnreadable;
  try {
    verdict = replay_->obey(*request, Replay::Clock::now());
  } catch (const std::exception& error) {
    context_.limited_log.warn("unreadable", error.what());
  }
  if (verdict != ControlVerdict::kSearching) return verdict;
  const std::int64_t before = std::exchange(search_session_, sender);
  if (before != kKey && before != sender) guard_.answer(before, ControlVerdict::kReplaced);
  return verdict;
}

void ReplayControls::end_search(bool is_found) {
  const ControlVerdict verdict = is_found ? ControlVerdict::kObeyed : ControlVerdict::kBeyondEnd;
  if (const std::int64_t sender = std::exchange(search_session_, kKey); sender != kKey) {
    guard_.answer(sender, verdict);
  }
  if (!is_found) context_.limited_log.info("search", outcome(verdict));
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
  if (replay_ == nullptr || !replay_->is_controllable() || !replay_->is_begun()) return {};
  const std::int64_t position_us = replay_->position_us(Replay::Clock::now());
  if (replay_->is_searching()) return "searching " + seconds_text(position_us);
  if (replay_->is_paused()) return "paused at " + seconds_text(position_us);
  const std::string position = "at " + seconds_text(position_us / 1000 * 1000);
  if (replay_->speed() == 1) return position;
  return fmt::format("{}, speed {:g}", position, replay_->speed());
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
  report.add_unless_zero("controls_for_others", guard_.for_others());
  if (guard_.answered_session() != 0) {
    report.counters.emplace_back(kControlSession, guard_.answered_session());
    report.counters.emplace_back(kControlVerdict, static_cast<std::int64_t>(guard_.verdict()));
  }
}

}  // namespace puck
