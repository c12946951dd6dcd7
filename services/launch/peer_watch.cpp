#include "services/launch/peer_watch.h"

#include <algorithm>

#include "common/messages/host_time.h"

namespace puck {
namespace {

// Limits the size of STATUS in a large network.
constexpr std::size_t kMostOffsets = 6;
constexpr std::size_t kMostNameBytes = 32;
// The services' loops run up to 1000 times a second, and a look takes longer with more peers.
constexpr std::int64_t kLookPeriodUs = 20'000;

}  // namespace

PeerWatch::PeerWatch(StatusReporter& status, spdlog::logger& log)
    : status_(status), log_(log), book_(status.service()) {
  status.listen([this](const PeerStatus& heard, const Receipt& receipt) {
    book_.hear(heard, status_.clock_of(heard.session).has_value(), receipt.monotonic_us);
  });
}

void PeerWatch::poll() {
  const std::int64_t now_us = host_monotonic_us();
  if (now_us < due_us_) return;
  due_us_ = now_us + kLookPeriodUs;
  for (const PeerNews& news : book_.look(now_us)) {
    log_.log(news.is_trouble ? spdlog::level::warn : spdlog::level::info, news.text);
  }
  const PeerTrouble& trouble = book_.trouble();
  const bool both = !trouble.silent.empty() && !trouble.twice.empty();
  status_.set_trouble_of_peers(
      trouble.twice.empty() ? ServiceState::kWaiting : ServiceState::kDegraded,
      trouble.silent + (both ? "; " : "") + trouble.twice);
}

void PeerWatch::report(StatusReport& report) const {
  const std::size_t shown = std::min(book_.peers().size(), kMostOffsets);
  for (std::size_t i = 0; i < shown; ++i) {
    const PeerBook::Peer& peer = book_.peers()[i];
    const SenderClock clock = status_.clock_of(peer.session);
    if (!clock) continue;
    report.counters.emplace_back("clock_offset_us " + peer.service.substr(0, kMostNameBytes),
                                 clock->ahead_us);
  }
}

}  // namespace puck
