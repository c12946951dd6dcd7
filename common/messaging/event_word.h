#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>

#include "common/events/sensor_size.h"
#include "puck/event_packet_t.hpp"

namespace puck {

/// Layout of an event in its 32-bit word, from the lowest bit: dt, polarity, y, x.
template <int kX, int kY, int kDt>
struct EventWord {
  static_assert(kX + kY + kDt + 1 == 32);
  static constexpr int kXBits = kX;
  static constexpr int kYBits = kY;
  static constexpr std::uint32_t kMaxDtUs = (1U << kDt) - 1;

  static constexpr std::uint32_t dt_us(std::uint32_t word) { return word & kMaxDtUs; }
  static constexpr std::uint32_t polarity(std::uint32_t word) { return word >> kDt & 1U; }
  static constexpr std::uint32_t y(std::uint32_t word) {
    return word >> (kDt + 1) & ((1U << kY) - 1);
  }
  static constexpr std::uint32_t x(std::uint32_t word) { return word >> (kDt + 1 + kY); }

  static constexpr std::uint32_t pack(std::uint32_t x, std::uint32_t y, std::uint32_t polarity,
                                      std::uint32_t dt_us) {
    return x << (kDt + 1 + kY) | y << (kDt + 1) | polarity << kDt | dt_us;
  }
};

using EventWordX10Y9 = EventWord<10, 9, 12>;
using EventWordX11Y10 = EventWord<11, 10, 10>;
using EventWordX11Y11 = EventWord<11, 11, 9>;

/// The encoding with the longest dt that holds a sensor of this size.
inline std::int32_t encoding_for(SensorSize sensor) {
  const auto fits = [sensor](int x_bits, int y_bits) {
    return sensor.width <= 1 << x_bits && sensor.height <= 1 << y_bits;
  };
  if (fits(EventWordX10Y9::kXBits, EventWordX10Y9::kYBits)) {
    return event_packet_t::ENCODING_X10_Y9_DT12;
  }
  if (fits(EventWordX11Y10::kXBits, EventWordX11Y10::kYBits)) {
    return event_packet_t::ENCODING_X11_Y10_DT10;
  }
  return event_packet_t::ENCODING_X11_Y11_DT9;
}

/// Calls `use(Word{})` with the word's layout. Check the encoding first: an unknown one counts as
/// the last one.
template <typename Use>
decltype(auto) with_event_word(std::int32_t encoding, Use&& use) {
  if (encoding == event_packet_t::ENCODING_X10_Y9_DT12) return use(EventWordX10Y9{});
  if (encoding == event_packet_t::ENCODING_X11_Y10_DT10) return use(EventWordX11Y10{});
  return use(EventWordX11Y11{});
}

/// Words are little-endian on the wire.
inline std::uint32_t load_event_word(const std::uint8_t* data) {
  std::uint32_t word = 0;
  std::memcpy(&word, data, sizeof word);
  if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap32(word);
  return word;
}

inline void store_event_word(std::uint8_t* data, std::uint32_t word) {
  if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap32(word);
  std::memcpy(data, &word, sizeof word);
}

}  // namespace puck
