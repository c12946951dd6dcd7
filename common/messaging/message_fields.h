#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "common/messaging/channels.h"

namespace puck {

/// Receives a field's name, the index of an array element if it is one, and the value as text. The
/// views are valid during the call.
using FieldVisitor = std::function<void(std::string_view name, std::optional<std::size_t> index,
                                        std::string_view value)>;

/// Visits every value of a message in the order of its fields, for people and tables. It follows
/// the layout of the channel's type, so a new type needs no further code. Numbers have the shortest
/// exact form, booleans are 0 and 1, a byte field is one hexadecimal value; an empty array has no
/// values. Requires bytes that passed check_message().
void visit_fields(Channel channel, std::span<const std::uint8_t> bytes, const FieldVisitor& visit);

}  // namespace puck
