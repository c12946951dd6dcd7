#pragma once

#include <algorithm>
#include <cstdint>

namespace puck {

/// Calls `put(high)` for the time words that bring the clock of a Prophesee stream from `from` (−1:
/// no time word yet) to `to`. The words hold `bits` bits of it. A first time and a pause are
/// counted through in steps of a quarter of that range, which no reader takes for a clock set back;
/// after a jump the word is repeated, so that it is not taken for a glitch.
template <typename Put>
void count_time_up(std::int64_t from, std::int64_t to, int bits, Put put) {
  const std::int64_t largest_step = std::int64_t{1} << (bits - 2);
  if (from < 0) put(std::int64_t{0});
  const std::int64_t start = std::max<std::int64_t>(from, 0);
  for (std::int64_t high = start + largest_step; high < to; high += largest_step) put(high);
  put(to);
  if (to - start > 1) put(to);
}

}  // namespace puck
