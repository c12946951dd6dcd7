#pragma once

#include <cstdint>

namespace puck {

/// Keeps to one of several publishers on a channel: the first that is heard, until it has been
/// silent. And to the order of its messages. One thread.
class SinglePublisher {
 public:
  static constexpr std::int64_t kSilentAfterUs = 500'000;

  enum class Verdict {
    kNewPublisher,  ///< The first message of the publisher that is followed from now on.
    kAccepted,
    kLate,            ///< Not newer than the one before: late, a duplicate or a replay.
    kOtherPublisher,  ///< Somebody else is followed.
  };

  /// A message that came at `now_us` (CLOCK_MONOTONIC). Only accepted ones keep a publisher.
  Verdict hear(std::int64_t session, std::int64_t seq, std::int64_t now_us);

  /// Of the publisher that is followed; 0 before the first.
  std::int64_t session() const { return session_; }
  /// Nobody has been accepted for so long that anyone new may follow.
  bool is_silent(std::int64_t now_us) const {
    return !has_publisher_ || now_us - heard_us_ > kSilentAfterUs;
  }

 private:
  bool has_publisher_ = false;
  std::int64_t session_ = 0;
  std::int64_t newest_seq_ = 0;
  std::int64_t heard_us_ = 0;
};

}  // namespace puck
