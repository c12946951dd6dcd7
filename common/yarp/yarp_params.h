#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace puck {

/// The arm's control board and its driven joints. Keys arm.yarp.*.
struct YarpParams {
  std::string host = "127.0.0.1";       ///< Name server: host name or IPv4 address.
  int port = 10000;                     ///< Port of the name server.
  std::string robot = "/icub";          ///< Prefix of the robot's ports.
  std::string part = "right_arm";       ///< Part of the robot.
  std::string local_name = "puck-arm";  ///< Our name in requests to the board.
  /// Numbers of the driven joints on the board, in ascending order.
  std::vector<int> joints{0, 1, 2, 3, 4, 5, 6};
  /// Limits of each of these joints, deg, within the board's limits. No keys: from the joint table.
  std::vector<double> lowest_deg;
  std::vector<double> highest_deg;
  /// Longest time without encoders, without a new stamp, or without accepted set-points, ms.
  int silent_ms = 100;
  int connect_timeout_ms = 1000;
  int answer_timeout_ms = 500;  ///< Timeout of a request's answer.
  /// Delay of the next attempt after a failure, ms; doubled for each further one, up to 5 s.
  int retry_ms = 250;
  /// Period of the queries of the joints' modes, ms.
  int check_modes_ms = 100;
  /// Largest distance of a connection's first set-point from the encoders, deg.
  double start_within_deg = 2;
  /// Largest distance of each later set-point from the previous one, or, as for the first, from the
  /// encoders, deg.
  double max_step_deg = 5;

  /// `/icub/right_arm/state:o` for `state:o`.
  std::string port_name(std::string_view port_of_part) const {
    return robot + "/" + part + "/" + std::string(port_of_part);
  }
};

/// Throws std::invalid_argument that names the key when a value is out of range.
void check(const YarpParams& params);

}  // namespace puck
