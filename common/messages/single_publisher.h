#pragma once

#include <cstdint>

namespace puck {

/// Follows one of several publishers on a channel: the first one heard, until it falls silent.
/// Accepts its messages in order only. One thread.
class SinglePublisher {
 public:
  static constexpr std::int64_t kSilentAfterUs = 500'000;

  enum class Verdict {
    kNewPublisher,  ///< First message of a publisher that is followed from now on.
    kAccepted,
    kLate,            ///< Not newer than the previous one: late, duplicate or replayed.
    kOtherPublisher,  ///< Another publisher is followed.
  };

  /// Judges a message of `now_us` (CLOCK_MONOTONIC). Accepted messages prolong the publisher's
  /// time.
  Verdict hear(std::int64_t session, std::int64_t seq, std::int64_t now_us);

  /// Session of the followed publisher; 0 before the first one.
  std::int64_t session() const { return session_; }
  /// Whether the followed publisher has been silent for so long that any other may replace it.
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
