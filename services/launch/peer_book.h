#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/messaging/channels.h"

namespace puck {

/// What is new among the services on the bus.
struct PeerNews {
  std::string text;  ///< "puck-tracker on lab2, pid 7, is silent"
  bool is_trouble = false;
};

/// What is wrong among them, as long as it is.
struct PeerTrouble {
  std::string silent;  ///< Services that are needed and say nothing; empty: none.
  std::string twice;   ///< Services that are there twice; empty: none.
};

/// The services that are heard under our prefix, by their STATUS: which of those that this one
/// lives on have fallen silent, and which are there twice. Fed with statuses and times. A run
/// counts once it has answered us, so a log that is played is nobody. One thread.
class PeerBook {
 public:
  /// STATUS comes every 100 ms; a service that has not spoken for so long is frozen or gone.
  static constexpr std::int64_t kSilentAfterUs = 400'000;

  /// `own_service`: what this one is, for it may be there twice itself.
  explicit PeerBook(std::string own_service) : own_service_(std::move(own_service)) {}

  /// The services that this one lives on.
  void need(const std::vector<std::string>& services) {
    for (const std::string& service : services) needs_.push_back({service, {}});
  }

  /// `answers`: it has answered our own STATUS.
  void hear(const service_status_t& status, bool answers, std::int64_t now_us);
  /// Compares with the last time; each news is told once. What was missed while this service itself
  /// did not look is held against nobody.
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
  /// "puck-camera on lab2, pid 7"; "session 31" for one that is not known.
  std::string name_of(std::int64_t session) const;

 private:
  struct Need {
    std::string service;
    std::string missing;  // who it was, and what became of it; empty: it is there
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
