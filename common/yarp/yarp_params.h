#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace puck {

/// Where the arm's control board is, and which of its joints are ours. Keys arm.yarp.*.
struct YarpParams {
  std::string host = "127.0.0.1";       ///< Of the name server: a name or an IPv4 address.
  int port = 10000;                     ///< Of the name server.
  std::string robot = "/icub";          ///< What the robot's ports begin with.
  std::string part = "right_arm";       ///< Of the robot.
  std::string local_name = "puck-arm";  ///< What the board calls us.
  /// The numbers of the driven joints on the board, in ascending order.
  std::vector<int> joints{0, 1, 2, 3, 4, 5, 6};
  /// How far each of these may go, deg; within what the board allows. No keys: from the joint
  /// table.
  std::vector<double> lowest_deg;
  std::vector<double> highest_deg;
  /// So long the board may send no encoders, keep its stamp, or take no set-points, ms.
  int silent_ms = 100;
  int connect_timeout_ms = 1000;
  int answer_timeout_ms = 500;  ///< For an answer to a request.
  /// After a failure the next try waits so long, ms; each further time twice as long, up to 5 s.
  int retry_ms = 250;
  /// The modes of the joints are asked for so often, ms.
  int check_modes_ms = 100;
  /// The first set-point of a connection lies so near the encoders, deg.
  double start_within_deg = 2;
  /// Each further one so near the one before, or as near the encoders as a first one, deg.
  double max_step_deg = 5;

  /// `/icub/right_arm/state:o` for `state:o`.
  std::string port_name(std::string_view port_of_part) const {
    return robot + "/" + part + "/" + std::string(port_of_part);
  }
};

/// Throws std::invalid_argument that names the key when a value is out of its range.
void check(const YarpParams& params);

}  // namespace puck
