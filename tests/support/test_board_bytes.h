#pragma once

#include <optional>
#include <string>
#include <vector>

namespace puck {

/// YARP's binary carrier for the test board, written from observations of a real one and
/// independently of common/yarp, so that a mistake there is found.

/// Takes `size` bytes from the beginning, once there are as many.
std::optional<std::string> take_bytes(std::string& input, std::size_t size);

/// The name in a greeting; throws std::runtime_error for anything else.
std::optional<std::string> take_hello(std::string& input);

/// The blocks of a message; throws std::runtime_error.
std::optional<std::vector<std::string>> take_message(std::string& input);

/// A message of these blocks; the first one of a port's message is one of the two below.
std::string carrier_message(const std::vector<std::string>& blocks);
std::string stamp_block(long long count, double time_s);
std::string block_without_stamp();

/// Content of a message to command:i; decoding throws std::runtime_error.
struct SetPointMessage {
  std::string kind;                 // dpos, dpog
  std::vector<std::size_t> joints;  // of dpog
  std::vector<double> deg;
};
SetPointMessage read_set_points(const std::vector<std::string>& blocks);

/// A message of state:o with the stamp, in the blocks of a real board.
std::string state_message(long long count, double time_s, const std::vector<double>& deg);
std::string state_message_without_stamp(const std::vector<double>& deg);

}  // namespace puck
