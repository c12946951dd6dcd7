#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace puck {

/// Bytes on the wire; numbers are little-endian on any machine.
using Bytes = std::vector<std::uint8_t>;

inline void append_word(Bytes& to, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) to.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}
inline void append_int(Bytes& to, std::int32_t value) {
  append_word(to, static_cast<std::uint32_t>(value), 4);
}
inline void append_real(Bytes& to, double value) {
  append_word(to, std::bit_cast<std::uint64_t>(value), 8);
}

/// Reads numbers from borrowed bytes. The caller must check with left() that they are there.
class LittleEndianReader {
 public:
  explicit LittleEndianReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size() - at_; }
  std::size_t at() const { return at_; }
  std::int32_t whole() { return static_cast<std::int32_t>(word(4)); }
  double real() { return std::bit_cast<double>(word(8)); }
  std::span<const std::uint8_t> take(std::size_t count) {
    const auto part = bytes_.subspan(at_, count);
    at_ += count;
    return part;
  }

 private:
  std::uint64_t word(int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value |= std::uint64_t{bytes_[at_++]} << (8 * i);
    return value;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace puck
