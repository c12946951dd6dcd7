#include "common/monitor/publisher_list.h"

#include <algorithm>

namespace puck {
namespace {

constexpr std::size_t kMaxPublishers = 16;

}  // namespace

void PublisherList::hear(std::int64_t session, const Sender& sender, std::int64_t now_us) {
  HeardPublisher& publisher = place_of(session, now_us);
  publisher.sender = sender;
  publisher.last_us = now_us;
  ++publisher.messages;
}

HeardPublisher& PublisherList::place_of(std::int64_t session, std::int64_t now_us) {
  if (newest_ < heard_.size() && heard_[newest_].session == session) return heard_[newest_];
  auto place = std::find_if(heard_.begin(), heard_.end(), [session](const HeardPublisher& other) {
    return other.session == session;
  });
  if (place == heard_.end()) {
    const HeardPublisher added{.session = session, .first_us = now_us};
    if (heard_.size() < kMaxPublishers) {
      place = heard_.insert(heard_.end(), added);
    } else {
      place = std::min_element(
          heard_.begin(), heard_.end(),
          [](const HeardPublisher& a, const HeardPublisher& b) { return a.last_us < b.last_us; });
      *place = added;
    }
  }
  newest_ = static_cast<std::size_t>(place - heard_.begin());
  return *place;
}

std::vector<HeardPublisher> PublisherList::present(std::int64_t now_us,
                                                   std::int64_t life_us) const {
  std::vector<HeardPublisher> present;
  for (std::size_t i = 0; i < heard_.size(); ++i) {
    if (i == newest_ || now_us - heard_[i].last_us <= life_us) present.push_back(heard_[i]);
  }
  std::sort(present.begin(), present.end(), [](const HeardPublisher& a, const HeardPublisher& b) {
    return a.first_us < b.first_us;
  });
  return present;
}

}  // namespace puck
