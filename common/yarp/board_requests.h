#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/yarp/board_answer.h"
#include "common/yarp/text_connection.h"

namespace puck {

/// Range of a joint, deg.
struct JointRange {
  double lowest_deg = 0;
  double highest_deg = 0;
};

/// Requests on a board's port rpc:i, one at a time. Errors throw YarpError that names the request.
class BoardRequests {
 public:
  /// `patience`: timeout of each answer.
  BoardRequests(const PortAddress& address, std::string_view local_name, const Waiter& waiter,
                SteadyClock::duration patience, Deadline connected_by);

  int axes();
  std::string name(int joint);
  JointRange range(int joint);
  /// Modes of all joints.
  std::vector<std::string> modes(std::size_t axes);

  // Asynchronous requests.

  void begin_modes();
  void begin_set_mode(int joint, std::string_view mode);
  bool is_waiting() const { return asked_at_.has_value(); }
  /// Timeout of the pending answer.
  Deadline late_at() const { return *asked_at_ + patience_; }
  /// The pending request.
  const std::string& asked() const { return asked_; }
  /// `std::nullopt` until the answer has come.
  std::optional<BoardAnswer> answer_now();

  int descriptor() const { return connection_.descriptor(); }
  /// From the newest request to its answer.
  std::int64_t round_trip_us() const { return round_trip_us_; }

  /// Puts the joints that are in mode `from` into mode `to`, by the deadline, whatever request is
  /// pending. For the end of a session.
  void leave_mode(const std::vector<int>& joints, std::size_t axes, std::string_view from,
                  std::string_view to, const Waiter& waiter, Deadline deadline);

 private:
  void begin(const std::string& request);
  BoardAnswer ask(const std::string& request, const Waiter& waiter, Deadline deadline);
  BoardAnswer ask(const std::string& request);
  void note_answer();

  const Waiter& waiter_;
  SteadyClock::duration patience_;
  TextConnection connection_;
  std::string asked_;
  std::optional<SteadyClock::time_point> asked_at_;
  std::int64_t round_trip_us_ = 0;
};

}  // namespace puck
