#pragma once

#include <optional>
#include <string>
#include <vector>

namespace puck {

/// YARP's binary carrier as a test board speaks it. Written from what was observed of a real one
/// and on its own, so that a mistake of common/yarp is not answered with the same.

/// Takes `size` bytes from the beginning once they have come.
std::optional<std::string> take_bytes(std::string& input, std::size_t size);

/// The name in a greeting; throws std::runtime_error when it is none.
std::optional<std::string> take_hello(std::string& input);

/// The blocks of a message; throws std::runtime_error.
std::optional<std::vector<std::string>> take_message(std::string& input);

/// What a message to command:i says; throws std::runtime_error.
struct SetPointMessage {
  std::string kind;                 // dpos, dpog
  std::vector<std::size_t> joints;  // of dpog
  std::vector<double> deg;
};
SetPointMessage read_set_points(const std::vector<std::string>& blocks);

/// A message of state:o with the stamp, in the blocks in which a real board sends it.
std::string state_message(long long count, double time_s, const std::vector<double>& deg);
std::string state_message_without_stamp(const std::vector<double>& deg);

}  // namespace puck
