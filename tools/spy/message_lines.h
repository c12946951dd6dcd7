#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/messaging/channels.h"

namespace puck {

/// Every field of a message with its value, `width` characters a line at most; of arrays several
/// values a line, and the first 256 events as such. Only for bytes that check_message() let pass.
std::vector<std::string> message_lines(Channel channel, std::span<const std::uint8_t> bytes,
                                       std::size_t width);

/// `name  value`, on as many lines as the value needs.
void add_field(std::vector<std::string>& lines, const std::string& name, std::string value,
               std::size_t width);

}  // namespace puck
