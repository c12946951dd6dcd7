#pragma once

#include <cstddef>
#include <span>

namespace puck {

/// Cuts a byte stream into little-endian words, whatever pieces it comes in.
template <typename Word>
class WordAssembler {
 public:
  /// Calls `take(Word)` for each whole word as long as it returns true. Returns how many bytes were
  /// used; the bytes of a word that is not whole yet are kept, and count as used.
  template <typename Take>
  std::size_t feed(std::span<const std::byte> bytes, Take take) {
    std::size_t used = 0;
    if (partial_bytes_ > 0) {
      while (used < bytes.size() && partial_bytes_ < sizeof(Word)) put(bytes[used++]);
      if (partial_bytes_ < sizeof(Word)) return used;
      const Word word = partial_;
      reset();
      if (!take(word)) return used;
    }
    for (; bytes.size() - used >= sizeof(Word); used += sizeof(Word)) {
      if (!take(load(bytes.data() + used))) return used + sizeof(Word);
    }
    while (used < bytes.size()) put(bytes[used++]);
    return used;
  }

  /// Bytes of a word that is not whole yet.
  std::size_t partial_bytes() const { return partial_bytes_; }

  void reset() {
    partial_ = 0;
    partial_bytes_ = 0;
  }

 private:
  static Word load(const std::byte* bytes) {
    Word word = 0;
    for (std::size_t i = 0; i < sizeof(Word); ++i) {
      word = static_cast<Word>(word | (std::to_integer<Word>(bytes[i]) << (8 * i)));
    }
    return word;
  }

  void put(std::byte byte) {
    partial_ = static_cast<Word>(partial_ | (std::to_integer<Word>(byte) << (8 * partial_bytes_)));
    ++partial_bytes_;
  }

  Word partial_ = 0;
  std::size_t partial_bytes_ = 0;
};

}  // namespace puck
