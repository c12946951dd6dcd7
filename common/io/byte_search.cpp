#include "common/io/byte_search.h"

#include <cstdint>

// The rest of the file, up to the namespace's end, is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/io/byte_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Where two characters first follow one another from `at` on, or a place before it that is no more
// than a vector's length from the end.
std::size_t skip_without_pair(char first, char second, const char* bytes, std::size_t at,
                              std::size_t size) {
#if HWY_TARGET != HWY_SCALAR
  const hn::ScalableTag<std::uint8_t> tag;
  const std::size_t lanes = hn::Lanes(tag);
  const auto wanted_first = hn::Set(tag, static_cast<std::uint8_t>(first));
  const auto wanted_second = hn::Set(tag, static_cast<std::uint8_t>(second));
  const auto is_pair_at = [&](std::size_t place) HWY_ATTR {
    const auto* const first_byte = reinterpret_cast<const std::uint8_t*>(bytes + place);
    return hn::And(hn::Eq(hn::LoadU(tag, first_byte), wanted_first),
                   hn::Eq(hn::LoadU(tag, first_byte + 1), wanted_second));
  };
  for (; at + 4 * lanes < size; at += 4 * lanes) {
    const auto is_pair = hn::Or(hn::Or(is_pair_at(at), is_pair_at(at + lanes)),
                                hn::Or(is_pair_at(at + 2 * lanes), is_pair_at(at + 3 * lanes)));
    if (!hn::AllFalse(tag, is_pair)) break;
  }
  for (; at + lanes < size; at += lanes) {
    const std::intptr_t found = hn::FindFirstTrue(tag, is_pair_at(at));
    if (found >= 0) return at + static_cast<std::size_t>(found);
  }
#else
  static_cast<void>(first), static_cast<void>(second), static_cast<void>(bytes);
  static_cast<void>(size);
#endif
  return at;
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {

HWY_EXPORT(skip_without_pair);

std::size_t find_start_of(std::string_view text, std::span<const std::byte> bytes) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (std::size_t at = 0; at < all.size(); ++at) {
    at = HWY_DYNAMIC_DISPATCH(skip_without_pair)(text[0], text[1], all.data(), at, all.size());
    if (at < all.size() && all[at] != text[0]) continue;
    const std::string_view rest = all.substr(at, text.size());
    if (rest == text.substr(0, rest.size())) return at;
  }
  return all.size();
}

}  // namespace puck
#endif
