#pragma once

#include <cstdint>
#include <vector>

#include "common/messaging/transport.h"

namespace puck {

/// One run of a publisher on one channel. Times are CLOCK_MONOTONIC.
struct HeardPublisher {
  std::int64_t session = 0;
  Sender sender{};  ///< Of the newest message.
  std::int64_t first_us = 0;
  std::int64_t last_us = 0;
  std::int64_t messages = 0;
};

/// Whether two runs overlap in time. The old run of a restarted publisher ends before the new one.
inline bool at_once(const HeardPublisher& a, const HeardPublisher& b) {
  return a.last_us > b.first_us && b.last_us > a.first_us;
}

/// The 16 runs of publishers heard last on one channel: bounded memory against forged runs.
class PublisherList {
 public:
  void hear(std::int64_t session, const Sender& sender, std::int64_t now_us);

  /// Runs heard in the `life_us` before now, and always the one heard last; in order of their
  /// start.
  std::vector<HeardPublisher> present(std::int64_t now_us, std::int64_t life_us) const;

 private:
  HeardPublisher& place_of(std::int64_t session, std::int64_t now_us);

  std::vector<HeardPublisher> heard_;
  std::size_t newest_ = 0;  // Index in heard_: usually the next sender.
};

}  // namespace puck
