#include "common/messages/single_publisher.h"

namespace puck {

SinglePublisher::Verdict SinglePublisher::hear(std::int64_t session, std::int64_t seq,
                                               std::int64_t now_us) {
  if (!is_silent(now_us) && session != session_) return Verdict::kOtherPublisher;
  // After a silence, the same publisher continues its numbers.
  const bool is_new = !has_publisher_ || session != session_;
  if (!is_new && seq <= newest_seq_) return Verdict::kLate;
  has_publisher_ = true;
  session_ = session;
  newest_seq_ = seq;
  heard_us_ = now_us;
  return is_new ? Verdict::kNewPublisher : Verdict::kAccepted;
}

}  // namespace puck
