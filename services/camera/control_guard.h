#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/messages/camera_control.h"
#include "common/messages/clock_offset.h"
#include "common/messages/host_now.h"
#include "services/camera/control_verdict.h"
#include "services/camera/replay_request.h"

namespace puck {

/// Decides which controls on the bus are requests to this camera, and counts them. One thread.
class ControlGuard {
 public:
  /// At most one request in this time is taken, whoever sends it: a seek costs reading.
  static constexpr std::int64_t kPeriodUs = 50'000;
  /// Limit for the age of a control's utime by its sender's clock, as for the arm's commands.
  static constexpr std::int64_t kMaxAgeUs = 200'000;

  enum class Judgement {
    kTake,          ///< A new request, which answer() must follow.
    kRepeat,        ///< Of a request that was taken.
    kOtherCamera,   ///< For another camera, or an earlier session of this one.
    kOld,           ///< Of a replayed log, or late. Refused.
    kFromFuture,    ///< Refused.
    kClockUnknown,  ///< The age is not known. Refused.
    kTooMany,       ///< Came too soon after the last one; a repeat may be taken. Refused.
  };

  /// `camera_session`: the session that a control must name. `sender`: the clock of the control's
  /// session.
  Judgement judge(const CameraControl& control, std::int64_t camera_session, const HostNow& now,
                  const SenderClock& sender);
  /// What became of the request that was taken of the sender `session`; also later, after a search.
  /// A repeat of it makes this the answer again.
  void answer(std::int64_t session, ControlVerdict verdict);

  std::int64_t obeyed() const { return obeyed_; }
  std::int64_t refused() const { return refused_; }
  /// Controls for other cameras, or an earlier session of this one.
  std::int64_t for_others() const { return for_others_; }
  /// The sender whose request was answered, or repeated, last; 0: none yet.
  std::int64_t answered_session() const { return answered_session_; }
  ControlVerdict verdict() const { return verdict_; }

 private:
  /// The newest request that was taken of a sender.
  struct Sender {
    std::int64_t session = 0;
    std::int64_t request = 0;
    ControlVerdict verdict = ControlVerdict::kSearching;  // Until answer().
    bool is_answered = false;
  };

  static constexpr std::size_t kSenders = 16;
  // The sender's clock may be ahead, so a control is accepted for up to twice its greatest age.
  // Until then its number must be known, or a copy of it would be taken again.
  static_assert(kSenders > 2 * kMaxAgeUs / kPeriodUs + 1);

  Sender* find(std::int64_t session);

  std::array<Sender, kSenders> senders_{};  // A ring of the newest ones.
  std::size_t next_sender_ = 0;
  std::optional<std::int64_t> taken_us_;
  std::int64_t obeyed_ = 0;
  std::int64_t refused_ = 0;
  std::int64_t for_others_ = 0;
  std::int64_t answered_session_ = 0;
  ControlVerdict verdict_ = ControlVerdict::kObeyed;
};

/// The request in a control; nothing if one of its values is out of range.
std::optional<ReplayRequest> request_in(const CameraControl& control);

}  // namespace puck
