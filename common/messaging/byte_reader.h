#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace puck {

/// Reads big-endian numbers one after the other from bytes that it borrows. The caller makes sure,
/// with has(), that they are there.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size() - at_; }
  bool has(std::size_t count) const { return count <= left(); }

  template <typename Whole>
  Whole whole() {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Whole); ++i) value = value << 8 | bytes_[at_ + i];
    at_ += sizeof(Whole);
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
