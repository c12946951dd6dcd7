#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/messaging/wire_layout.h"

namespace puck {

using Bytes = std::vector<std::uint8_t>;

/// The bytes of one field of a message, its elements apart; those of a byte array are one.
struct MessagePart {
  const WireField* field = nullptr;
  std::vector<Bytes> values;
};

/// A message taken apart along its layout, so that a part can be changed and the whole still be
/// one. What the bytes are too short for is missing; what they have too many is left out.
std::vector<MessagePart> parts_of(const WireLayout& layout, std::span<const std::uint8_t> bytes);

/// Behind the fingerprint of the layout.
Bytes message_of(const WireLayout& layout, const std::vector<MessagePart>& parts);

/// Gives an array another length and says so in its count, with all arrays that share the count.
/// New elements are copies of the last, or zeros. `count` is a field that counts.
void set_length(std::vector<MessagePart>& parts, const MessagePart& count, std::size_t length);

/// Whether another field's length is in this one.
bool is_count(const WireLayout& layout, const WireField& field);

void put_big_endian(Bytes& bytes, std::uint64_t value, int size);

}  // namespace puck
