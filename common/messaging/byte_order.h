#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace puck {

inline void put_big_endian(std::uint64_t value, std::uint8_t* to) {
  if constexpr (std::endian::native == std::endian::little) value = __builtin_bswap64(value);
  std::memcpy(to, &value, sizeof value);
}

inline void put_big_endian(std::uint32_t value, std::uint8_t* to) {
  if constexpr (std::endian::native == std::endian::little) value = __builtin_bswap32(value);
  std::memcpy(to, &value, sizeof value);
}

}  // namespace puck
