#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace puck {

/// An event as Prophesee's HDF5 files hold it.
struct EcfEvent {
  std::uint16_t x = 0;
  std::uint16_t y = 0;
  std::int16_t polarity = 0;
  std::int64_t t_us = 0;

  friend constexpr bool operator==(const EcfEvent&, const EcfEvent&) = default;
};
static_assert(sizeof(EcfEvent) == 16);

/// Prophesee's Event Compression Format, the HDF5 filter with this number.
inline constexpr int kEcfFilter = 0x8ECF;
/// Most events of one chunk.
inline constexpr std::size_t kMostEcfEvents = 65535;

/// Replaces `events` by those of one compressed chunk of any bytes. Throws std::invalid_argument,
/// which names the byte; `events` is then empty.
void decode_ecf(std::span<const std::byte> chunk, std::vector<EcfEvent>& events);

/// Replaces `chunk` by the smallest form of the events: up to kMostEcfEvents of them, in the order
/// of their times, with x and y below 2048 and a polarity of 0 or 1.
void encode_ecf(std::span<const EcfEvent> events, std::vector<std::byte>& chunk);

}  // namespace puck
