#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/control/arm_back_end.h"
#include "common/yarp/board_exchange.h"
#include "common/yarp/name_server.h"
#include "common/yarp/waiter.h"
#include "common/yarp/yarp_error.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// A real iCub's control board, in YARP's own wire protocol. Its thread connects, exchanges
/// set-points and encoders, and reconnects after every error; meanwhile the joints hold their
/// position.
///
/// **At the start** the board may start later than the controller. Before the first connection, a
/// failed attempt is retried and is not a fault, since nothing was moved yet; nor is a joint that
/// is not ready before any was taken. Errors that need a person are faults from the beginning: our
/// joints or limits do not fit the board, or a joint has a hardware fault.
///
/// **After a failure** reading() returns nothing until there is a new connection. A set-point is
/// accepted only when since then (1) fault() has been called, (2) reading() has returned encoders,
/// and (3) the set-point lies within `start_within_deg` of these: a controller restarts at what
/// reading() returns, at rest. The same holds after a refused set-point.
///
/// A connection only reads until the first accepted set-point. Then it puts the joints into mode
/// `posd`, if each is in `pos` or `posd`. It waits for a joint that is being calibrated, is driven
/// by another program or has its motor off. An emergency stop puts the joints into a hardware fault
/// at any time: it lasts until the robot's own tools have brought them back into `pos` and a
/// controller that was reset gives set-points again.
///
/// A set-point is sent within 100 ms or dropped, also when modes change slowly or a port is busy.
///
/// On destruction it puts the joints that its last connection took into mode `pos`: they stay stiff
/// in their place, as in `posd`, but late set-points of any program do not move them. The earlier
/// modes are not restored: they may have been slack, and the arm would fall. After a failure
/// without later set-points, the modes are left as they are.
class YarpBackEnd final : public ArmBackEnd {
 public:
  /// Looks up the name server's host. Throws std::invalid_argument that names the key when a value
  /// is out of range or the host is unknown.
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
  /// Returns the error that ended the connection; `std::nullopt` after a stop.
  std::optional<YarpError> serve(const PortAddress& name_server, const Waiter& waiter);

  YarpParams params_;
  std::vector<PortAddress> name_servers_;  // All addresses of the host, tried in turn.
  Waker waker_;
  BoardExchange exchange_;
  std::jthread thread_;
};

}  // namespace puck
