#pragma once

#include <cstdint>
#include <vector>

#include "common/messaging/transport.h"

namespace puck {

/// One run of a publisher, as one channel heard it. Times are CLOCK_MONOTONIC.
struct HeardPublisher {
  std::int64_t session = 0;
  Sender sender{};  ///< Of the newest message.
  std::int64_t first_us = 0;
  std::int64_t last_us = 0;
  std::int64_t messages = 0;
};

/// Whether both spoke after the other had begun. A restarted publisher does not: the old run is
/// silent by then.
inline bool at_once(const HeardPublisher& a, const HeardPublisher& b) {
  return a.last_us > b.first_us && b.last_us > a.first_us;
}

/// The runs of publishers on one channel: the 16 heard last, so that forged ones take no memory.
class PublisherList {
 public:
  void hear(std::int64_t session, const Sender& sender, std::int64_t now_us);

  /// Those heard in the `life_us` before now, and the one heard last in any case; the one that
  /// began first comes first.
  std::vector<HeardPublisher> present(std::int64_t now_us, std::int64_t life_us) const;

 private:
  HeardPublisher& place_of(std::int64_t session, std::int64_t now_us);

  std::vector<HeardPublisher> heard_;
  std::size_t newest_ = 0;  // Its place in heard_: mostly the one that speaks next.
};

}  // namespace puck
