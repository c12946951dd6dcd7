#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/yarp/board_exchange.h"
#include "common/yarp/board_ports.h"
#include "common/yarp/board_requests.h"
#include "common/yarp/set_point_gate.h"
#include "common/yarp/state_message.h"
#include "common/yarp/stream_connection.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// One connection to a control board, from the query for its ports to the first thing that goes
/// wrong. One thread.
class BoardSession {
 public:
  /// Connects, and checks the joints, their limits and that none is being calibrated: it only
  /// reads. Throws BoardError with the port that it is about.
  BoardSession(const YarpParams& params, const PortAddress& name_server, const Waiter& waiter,
               BoardExchange& exchange);

  /// Hands encoders and set-points over until the waiter is stopped. The first set-point puts the
  /// joints into the mode that takes set-points, since whoever gives one wants them to move; until
  /// then an emergency stop, which is a change of modes, is left alone. Throws BoardError as soon
  /// as the board cannot be trusted any more.
  void run();

  /// Leaves the joints that it has taken where they are, in mode `pos`, within 50 ms; not those
  /// that something else has put into another mode since.
  void leave();

 private:
  enum class Hold : std::uint8_t { kNone, kTaking, kTaken };
  BoardSession(const YarpParams& params, const BoardPorts& ports, const Waiter& waiter,
               BoardExchange& exchange);

  void check_joints();
  void check_modes();
  void begin_to_receive();
  std::string wrong_mode(const std::vector<std::string>& modes) const;

  void wait_for_fresh_encoders();
  void receive_encoders();
  JointReading take_state(std::span<const std::uint8_t> message);
  void begin_to_take();
  void send_set_point();
  void attend_requests();
  void heed(const BoardAnswer& answer);
  void check_silence() const;
  void wait_for_more() const;

  const YarpParams& params_;
  const Waiter& waiter_;
  BoardExchange& exchange_;
  BoardRequests requests_;
  StreamConnection state_;
  StreamConnection command_;
  SetPointGate gate_;
  std::size_t axes_ = 0;
  std::vector<std::string> names_;  // of the driven joints
  Hold hold_ = Hold::kNone;         // on these
  std::size_t joints_put_ = 0;  // into the mode that takes set-points, by what the board answered
  std::optional<BoardStamp> stamp_;
  Deadline received_at_;  // the newest encoders
  Deadline stamp_moved_at_;
  Deadline command_free_at_;  // last time that all set-points had gone out
  Deadline next_modes_at_;
  Deadline taken_by_;
  SteadyClock::time_point taken_at_;
  JointReading reading_;
};

}  // namespace puck
