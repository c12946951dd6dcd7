#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace puck {

/// A message in an LCM log: this mark, number and time of receipt (64 bits), the lengths of channel
/// name and message (32 bits), all big-endian; then the channel name without a NUL, then the
/// message.
inline constexpr std::array<std::uint8_t, 4> kLogMark{0xed, 0xa1, 0xda, 0x01};
inline constexpr std::size_t kLogHeaderBytes = 4 + 8 + 8 + 4 + 4;
inline constexpr std::size_t kLogMaxChannelBytes = 255;
inline constexpr std::size_t kLogMaxMessageBytes = std::size_t{1} << 28;  // LCM's own limit.

struct LogHeader {
  std::int64_t number = 0;  ///< Number of messages before this one in the log.
  std::int64_t utime = 0;   ///< Time of receipt, CLOCK_REALTIME, µs.
  std::size_t channel_bytes = 0;
  std::size_t message_bytes = 0;

  std::size_t record_bytes() const { return kLogHeaderBytes + channel_bytes + message_bytes; }
};

/// Nothing if no message can begin here: wrong mark, length out of bounds, too few bytes.
std::optional<LogHeader> parse_log_header(std::span<const std::uint8_t> bytes);

/// Writes the header into the first kLogHeaderBytes of `to`.
void put_log_header(std::span<std::uint8_t> to, const LogHeader& header);
/// Replaces the number in an existing header.
void put_log_number(std::span<std::uint8_t> record, std::int64_t number);

/// Writes a whole record; `to` has the length that the header gives.
void put_log_record(std::span<std::uint8_t> to, const LogHeader& header, std::string_view channel,
                    std::span<const std::uint8_t> message);

}  // namespace puck
