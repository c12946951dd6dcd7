#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/yarp/board_exchange.h"
#include "common/yarp/board_joints.h"
#include "common/yarp/board_ports.h"
#include "common/yarp/board_requests.h"
#include "common/yarp/joint_hold.h"
#include "common/yarp/set_point_gate.h"
#include "common/yarp/state_message.h"
#include "common/yarp/stream_connection.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// One connection to a control board, from the query for its ports to the first error. One thread.
class BoardSession {
 public:
  /// Connects and checks the joints, their limits and their modes; changes nothing on the board.
  /// Throws YarpError that names the port.
  BoardSession(const YarpParams& params, const PortAddress& name_server, const Waiter& waiter,
               BoardExchange& exchange);

  /// Exchanges encoders and set-points until the waiter is stopped. The first set-point takes the
  /// joints. Throws YarpError as soon as the board is unreliable, or its joints could not be
  /// taken.
  void run();

  /// As JointHold::leave().
  void leave() { hold_.leave(); }

 private:
  BoardSession(const YarpParams& params, const BoardPorts& ports, const Waiter& waiter,
               BoardExchange& exchange);

  void begin_to_receive();
  void wait_for_fresh_encoders();
  void receive_encoders();
  JointReading take_state(std::span<const std::uint8_t> message);
  void begin_to_take();
  void send_set_point();
  void attend_hold();
  void check_silence() const;
  void wait_for_more() const;

  const YarpParams& params_;
  const Waiter& waiter_;
  BoardExchange& exchange_;
  BoardRequests requests_;
  StreamConnection state_;
  StreamConnection command_;
  BoardJoints joints_;
  JointHold hold_;
  SetPointGate gate_;
  std::optional<PortStamp> stamp_;
  Deadline received_at_;  // Of the newest encoders.
  Deadline stamp_moved_at_;
  Deadline command_free_at_;  // Last time at which no set-point was unsent.
  JointReading reading_;
};

}  // namespace puck
