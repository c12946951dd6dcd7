#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "common/control/arm_back_end.h"
#include "common/yarp/newest_value.h"
#include "common/yarp/yarp_error.h"

namespace puck {

/// A control board's counters for STATUS.
struct YarpCounters {
  std::int64_t connections = 0;  ///< Connections that delivered encoders.
  std::int64_t failures = 0;     ///< Failed connections and attempts.
  std::int64_t encoders_received = 0;
  std::int64_t set_points_sent = 0;
  std::int64_t set_points_replaced = 0;  ///< Replaced by a newer one before they were sent.
  std::int64_t set_points_unheard = 0;   ///< Given without a connection known to the loop.
  std::int64_t set_points_refused = 0;
  std::int64_t set_points_withdrawn = 0;  ///< Withdrawn by the loop before they were sent.
  std::int64_t set_points_expired = 0;    ///< Too old before they could be sent.
  std::int64_t round_trip_us = 0;         ///< From the newest request to its answer.
  std::int64_t round_trip_max_us = 0;
  std::optional<std::int64_t> encoder_age_us;  ///< `std::nullopt`: no connection.
};

/// Exchanges set-points and encoders between the arm's loop and the thread of its control board.
/// Lock-free: the loop is real-time, the network is not.
class BoardExchange {
 public:
  /// Set-points older than this are not sent: the loop may have stopped.
  static constexpr std::int64_t kOldestSetPointUs = 100'000;

  explicit BoardExchange(std::int64_t silent_us) : silent_us_(silent_us) {}

  // Arm loop only.

  /// Returns false when the set-point is dropped: there is no connection, or the loop has not read
  /// its encoders yet, or has not read a fault yet.
  bool give_set_point(const JointAngles& set_point, std::int64_t monotonic_us);
  /// Cancels a set-point that was not sent yet.
  void withdraw_set_point();
  /// Whether this side holds the joints: set-points move them.
  bool holds();
  std::optional<JointReading> reading();
  /// Reports every fault to the loop once, also one that is over. Not a fault: a board that was off
  /// before the first connection, and joints that were never taken and are not ready.
  std::string fault(std::int64_t monotonic_us);
  /// Why there is no connection, when that is not a fault; empty: unknown, or a fault.
  std::string awaited();

  // Board thread only.

  void begin_connection(const JointReading& first);
  void put_encoders(const JointReading& reading);
  void lose_connection(const YarpError& why);
  /// Holds the joints until the connection is lost.
  void put_hold();
  /// The newest set-point that was not taken yet, without taking it; `std::nullopt` if there is
  /// none to send.
  std::optional<JointAngles> newest_set_point(std::int64_t monotonic_us);
  /// Takes the same.
  std::optional<JointAngles> take_set_point(std::int64_t monotonic_us);
  void count_sent();
  void refuse_set_point(const std::string& reason);
  void put_round_trip(std::int64_t round_trip_us);

  /// Safe from any thread. The numbers are read one by one.
  YarpCounters counters(std::int64_t monotonic_us) const;

 private:
  // State published by the board's thread.
  struct BoardState {
    std::int64_t connection = 0;          // Serial number.
    std::optional<JointReading> reading;  // Set while there is a connection.
    std::string why_none;                 // Reason for the missing connection.
    bool is_fault = false;                // The missing connection is a fault.
    bool holds = false;                   // The joints are held.
    std::int64_t faults = 0;              // Count so far.
    std::string newest_fault;
  };
  // A set-point with the connection and faults known to the loop; or a withdrawal.
  struct LoopRequest {
    std::optional<JointAngles> set_point;
    std::int64_t given_us = 0;  // CLOCK_MONOTONIC
    std::int64_t connection = 0;
    std::int64_t faults = 0;
  };
  // Relaxed: the counters are independent.
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
  void poll_set_point(std::int64_t monotonic_us);

  const std::int64_t silent_us_;
  NewestValue<BoardState> to_loop_;
  NewestValue<LoopRequest> to_board_;
  Counts counts_;

  // Arm loop only.
  std::int64_t read_connection_ = 0;  // Connection whose encoders the loop has read; 0: none.
  std::int64_t read_faults_ = 0;
  bool has_given_ = false;  // Given and not withdrawn.

  // Board thread only.
  BoardState state_;
  bool was_held_ = false;  // The joints were held on any connection so far.
  std::optional<LoopRequest> waiting_;
};

}  // namespace puck
