#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "common/io/word_assembler.h"

namespace puck {

/// A table of a FlatBuffer of any bytes, for reading; views the buffer. By hand, because the format
/// has two tables of one to three fields: generated code would add a compiler to the build, and its
/// checks would still have to be called.
class FlatTable {
 public:
  /// The root table of a buffer with its size before it and the identifier `id` of four letters.
  /// Throws std::invalid_argument when it is none.
  FlatTable(std::span<const std::byte> buffer, std::string_view id);

  /// Number in field `field`, counted from 0; `fallback` where it is left out. Throws
  /// std::invalid_argument when it lies outside the buffer.
  template <typename Number>
  Number number(std::size_t field, Number fallback) const {
    const std::size_t offset = field_offset(field);
    return offset == 0 ? fallback : static_cast<Number>(load<Unsigned<sizeof(Number)>>(offset));
  }

  /// The bytes of a list or text in field `field`; empty where it is left out. Throws
  /// std::invalid_argument when they lie outside the buffer.
  std::span<const std::byte> list(std::size_t field, std::size_t element_bytes) const;

 private:
  template <std::size_t bytes>
  using Unsigned = std::conditional_t<bytes == 8, std::uint64_t, std::uint32_t>;

  template <typename Word>
  Word load(std::size_t offset) const {
    check(offset, sizeof(Word));
    return load_word<Word>(buffer_.data() + offset);
  }
  void check(std::size_t offset, std::size_t bytes) const;
  // 0: left out.
  std::size_t field_offset(std::size_t field) const;

  std::span<const std::byte> buffer_;  // Without the size before it.
  std::size_t table_ = 0;
  std::size_t fields_ = 0;        // Where the offsets of its fields are …
  std::size_t fields_bytes_ = 0;  // … and their bytes, with a head of four.
};

}  // namespace puck
