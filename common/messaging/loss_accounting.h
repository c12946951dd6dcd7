#pragma once

#include <array>
#include <cstdint>

namespace puck {

/// Place of a message in the sequence of its publisher's run.
enum class Arrival {
  kNewSession,  ///< The first message heard of this run.
  kNewest,      ///< Newer than all before.
  kLate,        ///< Older, counted lost before, or too old to be told apart.
  kDuplicate,   ///< Received before.
};

struct LossCounters {
  std::int64_t received = 0;  ///< All messages, of any arrival.
  std::int64_t lost = 0;      ///< Not received so far.
  std::int64_t late = 0;
  std::int64_t duplicates = 0;
  std::int64_t sessions = 0;    ///< Runs of publishers heard.
  std::int64_t items_lost = 0;  ///< Events that came late or never (EVENTS).
};

/// Counts lost, late and duplicate messages of one channel by session and sequence number. Several
/// publishers may share the channel; a new session is a restart, not a loss. Remembers the 16
/// sessions heard last and the 64 newest numbers of each. One thread.
class LossAccount {
 public:
  /// `items_before`: items published before this message in its session; `items`: items in it.
  Arrival add(std::int64_t session, std::int64_t seq, std::int64_t items_before = 0,
              std::int64_t items = 0);

  const LossCounters& counters() const { return counters_; }

 private:
  static constexpr int kSessions = 16;
  static constexpr int kWindow = 64;

  struct Session {
    std::int64_t id = 0;
    std::int64_t first_seq = 0;  ///< Earlier numbers never count as lost.
    std::int64_t newest_seq = 0;
    std::int64_t items_expected = 0;  ///< `items_before` of the next message in order.
    std::uint64_t seen = 0;           ///< Bit i: number newest_seq − i was received.
    std::int64_t last_heard = 0;      ///< Value of the message counter; 0: this slot is free.
  };

  Session* find(std::int64_t id);
  Session& longest_silent();
  Arrival add_newer(Session& session, std::int64_t seq, std::int64_t items_before);
  Arrival add_older(Session& session, std::int64_t seq);

  std::array<Session, kSessions> sessions_{};
  LossCounters counters_;
};

}  // namespace puck
