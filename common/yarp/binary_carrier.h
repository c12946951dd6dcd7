#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "common/yarp/little_endian.h"

namespace puck {

/// YARP's binary TCP carrier without acknowledgements, which streaming ports use.

/// The bytes that open a connection from a port called `name`.
Bytes hello(std::string_view name);

inline constexpr std::size_t kHelloAnswerBytes = 8;
/// Throws YarpError.
void check_hello_answer(std::span<const std::uint8_t, kHelloAnswerBytes> answer);

/// The port command of a message.
enum class PortCommand : std::uint8_t {
  kData = 'd',
  kTurnRound = 'r',  ///< From now on the port sends and this side receives.
};

/// Appends a message to `to`: the command and, unless it is empty, the payload.
void append_message(PortCommand command, std::span<const std::uint8_t> payload, Bytes& to);

/// Extracts messages from a byte stream in pieces of any size.
class MessageReader {
 public:
  /// Ample for the encoders of 64 joints, which take 600 bytes.
  static constexpr std::size_t kBoardBytes = 4096;

  /// Refuses messages whose blocks exceed `most_bytes`.
  explicit MessageReader(std::size_t most_bytes = kBoardBytes) : most_bytes_(most_bytes) {}

  void feed(std::span<const std::uint8_t> bytes);

  /// The joined blocks of the next message, valid until the next call; `std::nullopt` until it is
  /// complete. Throws YarpError when the bytes are not a message.
  std::optional<std::span<const std::uint8_t>> next();

 private:
  std::size_t most_bytes_;
  Bytes bytes_;
  std::size_t begin_ = 0;  // First byte that was not returned yet.
};

}  // namespace puck
