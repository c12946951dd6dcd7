#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "common/messaging/channels.h"

namespace puck {

/// Is called with a field's name, its place in the array where it is one's element, and its value
/// as text. The views live as long as the call.
using FieldVisitor = std::function<void(std::string_view name, std::optional<std::size_t> index,
                                        std::string_view value)>;

/// Every value of a message in the order of its type's fields, for people and for tables: made from
/// the layout of the channel's type, so that a new type is shown without more. Numbers are written
/// as shortly as reads back the same, booleans as 0 and 1; a field of bytes is one value, in
/// hexadecimal. Of an empty array nothing is called. Only for bytes that check_message() let pass.
void visit_fields(Channel channel, std::span<const std::uint8_t> bytes, const FieldVisitor& visit);

}  // namespace puck
