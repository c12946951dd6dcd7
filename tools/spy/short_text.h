#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace puck {

/// Up to 5 characters: 3, 1938, 99999, 123k, 4.33M.
std::string short_count(std::int64_t count);

/// The same with one decimal below 100: 9.9, 1938, 39.4M.
std::string short_rate(double per_second);

/// Up to 6 characters: 3ms, 1.5s, 12m05s, 3h20m, 8d.
std::string short_duration(std::int64_t duration_us);

/// Text that is safe for a terminal: a question mark for each character outside printable ASCII.
std::string plain_text(std::string_view text);

/// Text of exactly `width` characters: cut with a ~ at the end, or padded with spaces.
std::string fit_left(std::string_view text, std::size_t width);
std::string fit_right(std::string_view text, std::size_t width);

}  // namespace puck
