#include "services/launch/peer_book.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace puck {
namespace {

constexpr std::size_t kMaxPeers = 64;
// Longest time between two looks; after a longer one this service was not listening.
constexpr std::int64_t kLongestLookAwayUs = 200'000;
// Two services exist at the same time if their STATUS alternates for this time; a killed and
// restarted one does not.
constexpr std::int64_t kOverlapUs = 150'000;
// Services that must be unique; two loggers are fine.
constexpr std::array<std::string_view, 4> kOnlyOne{"puck-camera", "puck-tracker", "puck-bridge",
                                                   "puck-arm"};

std::string name_of_peer(const PeerBook::Peer& peer) {
  return peer.service + " on " + peer.host + ", pid " + std::to_string(peer.pid);
}

bool is_only_one(const std::string& service) {
  return std::find(kOnlyOne.begin(), kOnlyOne.end(), service) != kOnlyOne.end();
}

void append(std::string& list, const std::string& item) {
  if (!list.empty()) list += "; ";
  list += item;
}

std::int64_t heard_together_us(const PeerBook::Peer& a, const PeerBook::Peer& b) {
  return std::min(a.heard_us, b.heard_us) - std::max(a.first_heard_us, b.first_heard_us);
}

}  // namespace

void PeerBook::hear(const PeerStatus& status, bool answers, std::int64_t now_us) {
  auto peer = std::find_if(peers_.begin(), peers_.end(),
                           [&](const Peer& other) { return other.session == status.session; });
  if (peer == peers_.end()) {
    if (!answers) return;
    if (peers_.size() == kMaxPeers) {
      peer = std::min_element(peers_.begin(), peers_.end(),
                              [](const Peer& a, const Peer& b) { return a.heard_us < b.heard_us; });
      *peer = {};
    } else {
      peer = peers_.insert(peers_.end(), Peer{});
    }
    peer->session = status.session;
    peer->first_heard_us = now_us;
  }
  peer->service = status.service;
  peer->host = status.host;
  peer->pid = status.pid;
  // After a silence the alternation must be observed again.
  if (now_us - peer->heard_us > kSilentAfterUs) peer->first_heard_us = now_us;
  peer->heard_us = now_us;
  peer->has_stopped = status.state == ServiceState::kStopping;
}

bool PeerBook::speaks(const Peer& peer, std::int64_t now_us) const {
  const std::int64_t since_us = std::max(peer.heard_us, listening_since_us_);
  return !peer.has_stopped && now_us - since_us <= kSilentAfterUs;
}

std::vector<PeerNews> PeerBook::look(std::int64_t now_us) {
  if (now_us - looked_us_ > kLongestLookAwayUs) listening_since_us_ = now_us;
  looked_us_ = now_us;
  std::vector<PeerNews> news;
  look_for_silent(now_us, news);
  look_for_twice(now_us, news);
  std::erase_if(peers_, [&](const Peer& peer) { return !speaks(peer, now_us); });
  return news;
}

void PeerBook::look_for_silent(std::int64_t now_us, std::vector<PeerNews>& news) {
  trouble_.silent.clear();
  for (Need& need : needs_) {
    // Of several services, one that is not silent.
    const Peer* newest = nullptr;
    for (const Peer& peer : peers_) {
      if (peer.service != need.service) continue;
      if (newest == nullptr || std::pair(speaks(peer, now_us), peer.heard_us) >
                                   std::pair(speaks(*newest, now_us), newest->heard_us)) {
        newest = &peer;
      }
    }
    if (newest != nullptr && speaks(*newest, now_us)) {
      if (!need.missing.empty())
        news.push_back({name_of_peer(*newest) + ", is heard again", false});
      need.missing.clear();
    } else if (newest != nullptr && need.missing.empty()) {
      need.missing =
          name_of_peer(*newest) + (newest->has_stopped ? ", has stopped" : ", is silent");
      news.push_back({need.missing, true});
    }
    if (!need.missing.empty()) append(trouble_.silent, need.missing);
  }
}

void PeerBook::look_for_twice(std::int64_t now_us, std::vector<PeerNews>& news) {
  const bool was_twice = !trouble_.twice.empty();
  trouble_.twice.clear();
  const auto find = [&](const std::string& text, bool told) {
    append(trouble_.twice, text);
    if (!told) news.push_back({text, true});
  };
  std::vector<Peer*> told;
  for (std::size_t i = 0; i < peers_.size(); ++i) {
    Peer& a = peers_[i];
    if (!is_only_one(a.service) || !speaks(a, now_us)) continue;
    if (a.service == own_service_ && a.heard_us - a.first_heard_us > kOverlapUs) {
      find("a second service of this kind is running: " + name_of_peer(a), a.told_twice);
      told.push_back(&a);
    }
    for (std::size_t j = i + 1; j < peers_.size(); ++j) {
      Peer& b = peers_[j];
      if (b.service != a.service || !speaks(b, now_us)) continue;
      if (heard_together_us(a, b) <= kOverlapUs) continue;
      find("two services of one kind: " + name_of_peer(a) + ", and " + name_of_peer(b),
           a.told_twice && b.told_twice);
      told.insert(told.end(), {&a, &b});
    }
  }
  for (Peer* peer : told) peer->told_twice = true;
  if (was_twice && trouble_.twice.empty()) {
    news.push_back({"every service is unique again", false});
  }
}

std::string PeerBook::name_of(std::int64_t session) const {
  const auto peer = std::find_if(peers_.begin(), peers_.end(),
                                 [&](const Peer& other) { return other.session == session; });
  if (peer != peers_.end()) return name_of_peer(*peer);
  return "session " + std::to_string(session);
}

}  // namespace puck
