#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "common/messaging/channels.h"

namespace puck {

/// The names of the columns of a channel's type, and the end of the line: `received_utime`, then
/// each field. An array of fixed length has a column for each value: covariance_0, …
std::string csv_header(Channel channel);

/// One message as a line of that table. An array of changing length is one cell, with a semicolon
/// between its values, and a backslash before each semicolon and backslash within them; bytes are
/// hexadecimal. Only for bytes that check_message() let pass.
std::string csv_line(Channel channel, std::int64_t received_utime,
                     std::span<const std::uint8_t> bytes);

}  // namespace puck
