#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/messaging/status_reporter.h"

namespace puck {

/// A change among the services on the bus.
struct PeerNews {
  std::string text;  ///< "puck-tracker on lab2, pid 7, is silent"
  bool is_trouble = false;
};

/// Present problems of the services on the bus.
struct PeerTrouble {
  std::string silent;  ///< Required services that are silent; empty: none.
  std::string twice;   ///< Services that run twice; empty: none.
};

/// The services heard under our prefix, by their STATUS: detects required ones that fall silent and
/// services that run twice. Driven by statuses and times. A run counts after it has answered us, so
/// a replayed log never counts as a peer. One thread.
class PeerBook {
 public:
  /// STATUS comes every 100 ms; a service that is silent for this time is frozen or gone.
  static constexpr std::int64_t kSilentAfterUs = 400'000;

  /// `own_service`: kind of this service, which may run twice itself.
  explicit PeerBook(std::string own_service) : own_service_(std::move(own_service)) {}

  /// Sets the services that this one requires.
  void need(const std::vector<std::string>& services) {
    for (const std::string& service : services) needs_.push_back({service, {}});
  }

  /// `answers`: it has answered our own STATUS.
  void hear(const PeerStatus& status, bool answers, std::int64_t now_us);
  /// Returns the changes since the last look, each once. Silence while this service itself did not
  /// look does not count.
  std::vector<PeerNews> look(std::int64_t now_us);
  /// As of the last look.
  const PeerTrouble& trouble() const { return trouble_; }

  struct Peer {
    std::int64_t session = 0;
    std::string service;
    std::string host;
    std::int32_t pid = 0;
    std::int64_t first_heard_us = 0;
    std::int64_t heard_us = 0;
    bool has_stopped = false;
    bool told_twice = false;
  };
  const std::vector<Peer>& peers() const { return peers_; }
  /// "puck-camera on lab2, pid 7"; "session 31" for an unknown one.
  std::string name_of(std::int64_t session) const;

 private:
  struct Need {
    std::string service;
    std::string missing;  // its name and what happened; empty: it is there
  };

  bool speaks(const Peer& peer, std::int64_t now_us) const;
  void look_for_silent(std::int64_t now_us, std::vector<PeerNews>& news);
  void look_for_twice(std::int64_t now_us, std::vector<PeerNews>& news);

  std::string own_service_;
  std::vector<Need> needs_;
  std::vector<Peer> peers_;
  std::int64_t looked_us_ = 0;
  std::int64_t listening_since_us_ = 0;
  PeerTrouble trouble_;
};

}  // namespace puck
