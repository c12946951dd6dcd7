#include "services/camera/control_guard.h"

namespace puck {
namespace {

std::optional<ControlGuard::Judgement> judge_age(const CameraControl& control, const HostNow& now,
                                                 const SenderClock& clock) {
  switch (freshness_of(control.utime, now, clock, ControlGuard::kMaxAgeUs)) {
    case Freshness::kOld:
      return ControlGuard::Judgement::kOld;
    case Freshness::kFromFuture:
      return ControlGuard::Judgement::kFromFuture;
    case Freshness::kClockUnknown:
      return ControlGuard::Judgement::kClockUnknown;
    case Freshness::kOfNow:
      break;
  }
  return std::nullopt;
}

}  // namespace

ControlGuard::Judgement ControlGuard::judge(const CameraControl& control,
                                            std::int64_t camera_session, const HostNow& now,
                                            const SenderClock& clock) {
  // A seek that was obeyed has changed the camera's session, which its repeats do not know.
  Sender* sender = find(control.session);
  const bool is_repeat = sender != nullptr && control.request <= sender->request;
  if (!is_repeat && control.camera_session != camera_session) {
    ++for_others_;
    return Judgement::kOtherCamera;
  }
  if (const auto refusal = judge_age(control, now, clock)) {
    ++refused_;
    return *refusal;
  }
  if (is_repeat) {
    if (sender->is_answered) {
      answered_session_ = sender->session;
      verdict_ = sender->verdict;
    }
    return Judgement::kRepeat;
  }
  if (taken_us_ && now.monotonic_us - *taken_us_ < kPeriodUs) {
    ++refused_;
    return Judgement::kTooMany;
  }
  taken_us_ = now.monotonic_us;
  if (sender == nullptr) {
    sender = &senders_[next_sender_];
    next_sender_ = (next_sender_ + 1) % senders_.size();
  }
  *sender = {control.session, control.request};
  return Judgement::kTake;
}

void ControlGuard::answer(std::int64_t session, ControlVerdict verdict) {
  if (Sender* sender = find(session)) {
    sender->verdict = verdict;
    sender->is_answered = true;
  }
  answered_session_ = session;
  verdict_ = verdict;
  if (verdict == ControlVerdict::kSearching) return;
  ++(verdict == ControlVerdict::kObeyed ? obeyed_ : refused_);
}

ControlGuard::Sender* ControlGuard::find(std::int64_t session) {
  for (Sender& sender : senders_) {
    if (sender.session == session) return &sender;
  }
  return nullptr;
}

std::optional<ReplayRequest> request_in(const CameraControl& control) {
  using Kind = ReplayRequest::Kind;
  switch (control.mode) {
    case CameraControlMode::kPause:
      return ReplayRequest{.kind = Kind::kPause};
    case CameraControlMode::kResume:
      return ReplayRequest{.kind = Kind::kResume};
    case CameraControlMode::kStep:
      if (control.step_us > ReplayRequest::kLongestStepUs) return std::nullopt;
      return ReplayRequest{.kind = Kind::kStep, .us = control.step_us};
    case CameraControlMode::kSeek:
      return ReplayRequest{.kind = Kind::kSeek, .us = control.position_us};
    case CameraControlMode::kSpeed:
      if (!(control.speed >= ReplayRequest::kSlowest && control.speed <= ReplayRequest::kFastest)) {
        return std::nullopt;
      }
      return ReplayRequest{.kind = Kind::kSpeed, .speed = control.speed};
    default:
      return std::nullopt;
  }
}

}  // namespace puck
