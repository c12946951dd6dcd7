#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/messaging/wire_layout.h"

namespace puck {

using Bytes = std::vector<std::uint8_t>;

/// The bytes of one field of a message, an entry for each element; a byte array is one element.
struct MessagePart {
  const WireField* field = nullptr;
  std::vector<Bytes> values;
};

/// A message split along its layout, so that a part can be changed and the whole composed again.
/// Parts beyond the bytes are missing; excess bytes are left out.
std::vector<MessagePart> parts_of(const WireLayout& layout, std::span<const std::uint8_t> bytes);

/// With the fingerprint of the layout.
Bytes message_of(const WireLayout& layout, const std::vector<MessagePart>& parts);

/// Changes the length of an array, its count, and all arrays that share the count. New elements are
/// copies of the last, or zeros. `count` is a count field.
void set_length(std::vector<MessagePart>& parts, const MessagePart& count, std::size_t length);

/// Whether the field is the count of another field.
bool is_count(const WireLayout& layout, const WireField& field);

void put_big_endian(Bytes& bytes, std::uint64_t value, int size);

}  // namespace puck
