#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "common/yarp/little_endian.h"

namespace puck {

/// YARP's binary tcp carrier without acknowledgements, which streaming ports speak.

/// How a connection begins, from one called `name`.
Bytes hello(std::string_view name);

inline constexpr std::size_t kHelloAnswerBytes = 8;
/// Throws BoardError.
void check_hello_answer(std::span<const std::uint8_t, kHelloAnswerBytes> answer);

/// What a message is for.
enum class PortCommand : std::uint8_t {
  kData = 'd',
  kTurnRound = 'r',  ///< From now on the port sends and we receive.
};

/// Writes a message behind what `to` holds: the command and, unless it is empty, the payload.
void append_message(PortCommand command, std::span<const std::uint8_t> payload, Bytes& to);

/// Cuts messages out of bytes that come in any pieces.
class MessageReader {
 public:
  /// A larger message is refused: the encoders of 64 joints take 600 bytes.
  static constexpr std::size_t kMostBytes = 4096;

  void feed(std::span<const std::uint8_t> bytes);

  /// The blocks of the next message, one after the other as their sender wrote them, until the next
  /// call; nothing when it has not come whole. Throws BoardError when this is no message.
  std::optional<std::span<const std::uint8_t>> next();

 private:
  Bytes bytes_;
  std::size_t begin_ = 0;  // of what has not been handed over
};

}  // namespace puck
