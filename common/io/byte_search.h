#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace puck {

/// Where `text`, of two characters or more, or a beginning of it that the end cuts off, first
/// occurs in `bytes`; their size without it. Vectorised; every instruction set gives the same
/// answer.
std::size_t find_start_of(std::string_view text, std::span<const std::byte> bytes);

}  // namespace puck
