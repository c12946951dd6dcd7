#include "tools/evaluate/estimate_log.h"

#include "common/messaging/conversions.h"

namespace puck {

EstimateLog::EstimateLog(const std::filesystem::path& path, const std::string& prefix,
                         std::int64_t events_session)
    : log_(path),
      channel_(channel_name(Channel::kEstimate, prefix)),
      events_session_(events_session) {}

bool EstimateLog::next(PublishedEstimate& estimate) {
  while (!began_anew_ && log_.next(record_)) {
    if (record_.channel != channel_) continue;
    if (decode(record_.bytes, estimate)) {
      ++malformed_;
      continue;
    }
    const bool rests_on_them = estimate.events_session == events_session_;
    if (session_ == 0 && rests_on_them) session_ = estimate.session;
    if (estimate.session != session_ || !rests_on_them) {
      ++of_others_;
      continue;
    }
    const Arrival arrival = losses_.add(estimate.session, estimate.seq);
    if (arrival == Arrival::kLate || arrival == Arrival::kDuplicate) continue;
    if (estimate.events_applied < newest_) {
      began_anew_ = true;
    } else if (estimate.events_applied == newest_) {
      ++repeated_;
    } else {
      newest_ = estimate.events_applied;
      return true;
    }
  }
  return false;
}

}  // namespace puck
