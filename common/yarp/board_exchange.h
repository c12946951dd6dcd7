#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "common/control/arm_back_end.h"
#include "common/yarp/board_error.h"
#include "common/yarp/newest_value.h"

namespace puck {

/// What STATUS tells of a control board.
struct YarpCounters {
  std::int64_t connections = 0;  ///< That came as far as encoders.
  std::int64_t failures = 0;     ///< Of connections, and of attempts at one.
  std::int64_t encoders_received = 0;
  std::int64_t set_points_sent = 0;
  std::int64_t set_points_replaced = 0;  ///< By a newer one before they went out.
  std::int64_t set_points_unheard = 0;   ///< Given while there was no connection to begin anew on.
  std::int64_t set_points_refused = 0;
  std::int64_t set_points_withdrawn = 0;  ///< By the loop before they went out.
  std::int64_t set_points_expired = 0;    ///< Too old before they could go out.
  std::int64_t round_trip_us = 0;         ///< The newest request and its answer.
  std::int64_t round_trip_max_us = 0;
  std::optional<std::int64_t> encoder_age_us;  ///< Nothing: no connection.
};

/// Where the arm's loop and the thread that talks to its control board meet. Neither ever waits for
/// the other: the loop is real-time, the network is not.
class BoardExchange {
 public:
  /// A set-point that could not go out for so long does not any more: the loop may have stopped.
  static constexpr std::int64_t kOldestSetPointUs = 100'000;

  explicit BoardExchange(std::int64_t silent_us) : silent_us_(silent_us) {}

  // For the arm's loop.

  /// Returns false when the set-point is dropped: there is no connection, or the loop has not read
  /// its encoders yet, or has not been told of a fault yet.
  bool give_set_point(const JointAngles& set_point, std::int64_t monotonic_us);
  /// What was given and did not go out yet is not to.
  void withdraw_set_point();
  /// Whether the joints are ours: set-points move them.
  bool holds();
  std::optional<JointReading> reading();
  /// The loop is told of every fault, be it over by then or not. A board that was not switched on
  /// before the first connection is none, nor are joints that were never ours and are not ready.
  std::string fault(std::int64_t monotonic_us);
  /// Why there is no connection, when that is no fault; empty: not known yet, or otherwise.
  std::string awaited();

  // For the board's thread.

  void begin_connection(const JointReading& first);
  void put_encoders(const JointReading& reading);
  void lose_connection(const BoardError& why);
  /// The joints are ours until the connection is lost.
  void put_hold();
  /// The newest set-point that was not taken yet, left there; nothing: none that is to go out.
  std::optional<JointAngles> newest_set_point(std::int64_t monotonic_us);
  /// The same, taken.
  std::optional<JointAngles> take_set_point(std::int64_t monotonic_us);
  void count_sent();
  void refuse_set_point(const std::string& reason);
  void put_round_trip(std::int64_t round_trip_us);

  /// Safe from any thread. Each number for itself.
  YarpCounters counters(std::int64_t monotonic_us) const;

 private:
  // What the board's thread knows.
  struct BoardWord {
    std::int64_t connection = 0;          // its number
    std::optional<JointReading> reading;  // while there is a connection
    std::string why_none;                 // no connection
    bool is_fault = false;                // that there is none
    bool holds = false;                   // the joints
    std::int64_t faults = 0;              // so far
    std::string newest_fault;
  };
  // A set-point, and what the loop knew of the board when it gave it; or none any more.
  struct LoopWord {
    std::optional<JointAngles> set_point;
    std::int64_t given_us = 0;  // CLOCK_MONOTONIC
    std::int64_t connection = 0;
    std::int64_t faults = 0;
  };
  // Relaxed: numbers that stand alone.
  struct Counts {
    std::atomic<std::int64_t> connections{0};
    std::atomic<std::int64_t> failures{0};
    std::atomic<std::int64_t> encoders_received{0};
    std::atomic<std::int64_t> set_points_sent{0};
    std::atomic<std::int64_t> set_points_replaced{0};
    std::atomic<std::int64_t> set_points_unheard{0};
    std::atomic<std::int64_t> set_points_refused{0};
    std::atomic<std::int64_t> set_points_withdrawn{0};
    std::atomic<std::int64_t> set_points_expired{0};
    std::atomic<std::int64_t> round_trip_us{0};
    std::atomic<std::int64_t> round_trip_max_us{0};
    std::atomic<std::int64_t> encoders_at_us{kNever};
  };
  static constexpr std::int64_t kNever = -1;

  void publish();
  void look_for_set_point(std::int64_t monotonic_us);

  const std::int64_t silent_us_;
  NewestValue<BoardWord> to_loop_;
  NewestValue<LoopWord> to_board_;
  Counts counts_;

  // The loop's.
  std::int64_t read_connection_ = 0;  // whose encoders it has; 0: none
  std::int64_t told_faults_ = 0;
  bool has_given_ = false;  // and not withdrawn

  // The board thread's.
  BoardWord word_;
  bool was_held_ = false;  // on any connection so far
  std::optional<LoopWord> waiting_;
};

}  // namespace puck
