#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace puck {

/// Little-endian bytes as a number.
template <typename Word>
Word load_word(const std::byte* bytes) {
  Word word = 0;
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(&word, bytes, sizeof word);
  } else {
    for (std::size_t i = 0; i < sizeof word; ++i) {
      word = static_cast<Word>(word | (std::to_integer<Word>(bytes[i]) << (8 * i)));
    }
  }
  return word;
}

/// A number as little-endian bytes.
template <typename Word>
void store_word(Word word, std::byte* bytes) {
  for (std::size_t i = 0; i < sizeof word; ++i) {
    bytes[i] = static_cast<std::byte>(word >> (8 * i) & 0xffU);
  }
}
template <typename Word>
void append_word(std::vector<std::byte>& bytes, Word word) {
  std::array<std::byte, sizeof word> stored{};
  store_word(word, stored.data());
  bytes.insert(bytes.end(), stored.begin(), stored.end());
}

/// Splits a byte stream, in pieces of any size, into little-endian words.
template <typename Word>
class WordAssembler {
 public:
  /// Calls `take(Word)` for each complete word as long as it returns true. Before each word that is
  /// complete in `bytes`, `take_run(bytes)` may take any number of words; it returns their bytes.
  /// Returns the number of bytes used; the bytes of an incomplete word are kept, and count as used.
  template <typename TakeRun, typename Take>
  std::size_t feed(std::span<const std::byte> bytes, TakeRun take_run, Take take) {
    std::size_t used = 0;
    if (partial_bytes_ > 0) {
      while (used < bytes.size() && partial_bytes_ < sizeof(Word)) put(bytes[used++]);
      if (partial_bytes_ < sizeof(Word)) return used;
      const Word word = partial_;
      reset();
      if (!take(word)) return used;
    }
    while (true) {
      used += take_run(bytes.subspan(used));
      if (bytes.size() - used < sizeof(Word)) break;
      const Word word = load_word<Word>(bytes.data() + used);
      used += sizeof(Word);
      if (!take(word)) return used;
    }
    while (used < bytes.size()) put(bytes[used++]);
    return used;
  }

  /// Number of bytes of an incomplete word.
  std::size_t partial_bytes() const { return partial_bytes_; }

  void reset() {
    partial_ = 0;
    partial_bytes_ = 0;
  }

 private:
  void put(std::byte byte) {
    partial_ = static_cast<Word>(partial_ | (std::to_integer<Word>(byte) << (8 * partial_bytes_)));
    ++partial_bytes_;
  }

  Word partial_ = 0;
  std::size_t partial_bytes_ = 0;
};

}  // namespace puck
