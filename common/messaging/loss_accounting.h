#pragma once

#include <array>
#include <cstdint>

namespace puck {

/// How a message stands among those of its publisher's run that came before.
enum class Arrival {
  kNewSession,  ///< The first that was heard of this run.
  kNewest,      ///< Newer than all before.
  kLate,        ///< An older one that had been counted lost, or older than can be told.
  kDuplicate,   ///< One that had come already.
};

struct LossCounters {
  std::int64_t received = 0;  ///< All that came, whatever its arrival.
  std::int64_t lost = 0;      ///< Never came, as far as is known now.
  std::int64_t late = 0;
  std::int64_t duplicates = 0;
  std::int64_t sessions = 0;    ///< Runs of publishers heard.
  std::int64_t items_lost = 0;  ///< Events that came late or never, of numbered items (EVENTS).
};

/// Tells lost, late and duplicate messages of one channel apart, by their session and sequence
/// number. Several publishers may share the channel; a new session is a restart, not a loss. It
/// remembers the 16 sessions heard last and the 64 newest numbers of each. One thread.
class LossAccount {
 public:
  /// `items_before`: items published before this message in its session; `items`: those in it.
  Arrival add(std::int64_t session, std::int64_t seq, std::int64_t items_before = 0,
              std::int64_t items = 0);

  const LossCounters& counters() const { return counters_; }

 private:
  static constexpr int kSessions = 16;
  static constexpr int kWindow = 64;

  struct Session {
    std::int64_t id = 0;
    std::int64_t first_seq = 0;  ///< Numbers before it were never missed.
    std::int64_t newest_seq = 0;
    std::int64_t items_expected = 0;  ///< `items_before` of the next message in order.
    std::uint64_t seen = 0;           ///< Bit i: number newest_seq − i has come.
    std::int64_t last_heard = 0;      ///< Messages received by then; 0: this place is free.
  };

  Session* find(std::int64_t id);
  Session& longest_silent();
  Arrival add_newer(Session& session, std::int64_t seq, std::int64_t items_before);
  Arrival add_older(Session& session, std::int64_t seq);

  std::array<Session, kSessions> sessions_{};
  LossCounters counters_;
};

}  // namespace puck
