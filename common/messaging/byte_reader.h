#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace puck {

/// Reads consecutive big-endian numbers from borrowed bytes. The caller must check with has() that
/// they exist.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size() - at_; }
  bool has(std::size_t count) const { return count <= left(); }

  template <typename Whole>
  Whole whole() {
    static_assert(sizeof(Whole) == 1 || sizeof(Whole) == 4 || sizeof(Whole) == 8);
    std::make_unsigned_t<Whole> value = 0;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    if constexpr (std::endian::native == std::endian::little) {
      if constexpr (sizeof value == 4) value = __builtin_bswap32(value);
      if constexpr (sizeof value == 8) value = __builtin_bswap64(value);
    }
    return static_cast<Whole>(value);
  }
  double real() { return std::bit_cast<double>(whole<std::uint64_t>()); }

  std::span<const std::uint8_t> take(std::size_t count) {
    const auto part = bytes_.subspan(at_, count);
    at_ += count;
    return part;
  }
  std::span<const std::uint8_t> rest() const { return bytes_.subspan(at_); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace puck
