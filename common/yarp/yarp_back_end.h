#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/control/arm_back_end.h"
#include "common/yarp/board_error.h"
#include "common/yarp/board_exchange.h"
#include "common/yarp/name_server.h"
#include "common/yarp/waiter.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// A real iCub's control board, in YARP's own wire protocol. A thread of its own connects, hands
/// set-points and encoders over, and connects again after whatever went wrong; the joints hold
/// where they are in the meantime.
///
/// **At the start** the board may come later than the controller: until there was a connection, one
/// that fails is tried again and is no fault, since nothing was moved yet; nor is a joint that is
/// not ready before any was ever taken. What no waiting mends is one from the beginning: our joints
/// or limits do not fit the board, or a joint is in a hardware fault.
///
/// **After a failure** reading() is nothing until there is a new connection, and a set-point is
/// heard only when since then (1) fault() has been asked, (2) reading() has given encoders, and (3)
/// the set-point lies within `start_within_deg` of these: a controller begins anew at what
/// reading() says, at rest. The same holds after a set-point that was refused.
///
/// A connection only reads until the first set-point that is heard, and puts the joints into mode
/// `posd` then, if each is in `pos` or `posd`. A joint that is being calibrated, that somebody else
/// drives or whose motor is off is not taken, but waited for. An emergency stop puts the joints
/// into a hardware fault, before or after they were taken: it lasts until the robot's own tools
/// have brought them back into `pos` and a controller that was reset gives set-points again.
///
/// A set-point goes out within 100 ms or never: modes that change slowly or a port that is busy do
/// not keep it.
///
/// When it ends, it leaves the joints that its last connection took in mode `pos`: they stay stiff
/// where they are, as in `posd`, but set-points of anybody that come late move nothing. The modes
/// of before are not restored: they may have been slack, and the arm would fall. After a failure
/// without set-points since, the modes are left as they are.
class YarpBackEnd final : public ArmBackEnd {
 public:
  /// Looks up the name server's host. Throws std::invalid_argument that names the key when a value
  /// is out of its range or there is no such host.
  explicit YarpBackEnd(const YarpParams& params);

  std::string_view name() const override { return "yarp"; }
  void command(const JointAngles& set_point, std::int64_t monotonic_us) override;
  std::optional<JointReading> reading(std::int64_t monotonic_us) override;
  std::string fault(std::int64_t monotonic_us) override;
  std::string awaited() override { return exchange_.awaited(); }
  void withdraw() override { exchange_.withdraw_set_point(); }
  bool holds() override { return exchange_.holds(); }

  std::vector<std::pair<std::string, std::int64_t>> counters(
      std::int64_t monotonic_us) const override;

  /// Safe from any thread.
  YarpCounters board_counters(std::int64_t monotonic_us) const {
    return exchange_.counters(monotonic_us);
  }

 private:
  void run(const std::stop_token& stop);
  /// Until it is stopped or something goes wrong: why.
  std::optional<BoardError> serve(const PortAddress& name_server, const Waiter& waiter);

  YarpParams params_;
  std::vector<PortAddress> name_servers_;  // all addresses of the host, tried in turn
  Waker waker_;
  BoardExchange exchange_;
  std::jthread thread_;
};

}  // namespace puck
