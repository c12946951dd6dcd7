#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/messaging/channels.h"

namespace puck {

/// All fields of a message, `width` characters a line at most; several values a line for arrays,
/// and the first 256 events decoded. Requires bytes that passed check_message().
std::vector<std::string> message_lines(Channel channel, std::span<const std::uint8_t> bytes,
                                       std::size_t width);

/// Adds `name  value`, on as many lines as the value needs.
void add_field(std::vector<std::string>& lines, const std::string& name, std::string value,
               std::size_t width);

}  // namespace puck
