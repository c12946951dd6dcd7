#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "common/messaging/channels.h"

namespace puck {

/// The header line of a channel's type: `received_utime`, then each field. An array of fixed length
/// has a column for each value: covariance_0, …
std::string csv_header(Channel channel);

/// One message as a line of that table. A variable-length array is one cell with semicolons between
/// its values and a backslash before each semicolon and backslash within them; bytes are
/// hexadecimal. Requires bytes that passed check_message().
std::string csv_line(Channel channel, std::int64_t received_utime,
                     std::span<const std::uint8_t> bytes);

}  // namespace puck
