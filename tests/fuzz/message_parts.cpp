#include "tests/fuzz/message_parts.h"

#include <algorithm>

#include "common/messaging/byte_reader.h"
#include "common/messaging/wire_layout.h"

namespace puck {
namespace {

std::size_t size_of(WireKind kind) {
  // A string's length precedes it.
  return kind == WireKind::kString ? 4 : wire_bytes(kind);
}

std::int32_t int32_of(const Bytes& bytes) { return ByteReader(bytes).whole<std::int32_t>(); }

std::int64_t count_of(const WireField& field, const std::vector<MessagePart>& before) {
  if (field.count_field.empty()) return field.fixed_count;
  for (const MessagePart& other : before) {
    if (other.field->name != field.count_field) continue;
    const bool is_whole = !other.values.empty() && other.values.front().size() == 4;
    return is_whole ? int32_of(other.values.front()) : 0;
  }
  return 0;
}

Bytes take(ByteReader& reader, std::size_t size) {
  const auto part = reader.take(std::min(size, reader.left()));
  return {part.begin(), part.end()};
}

Bytes take_value(ByteReader& reader, WireKind kind) {
  Bytes value = take(reader, size_of(kind));
  if (kind == WireKind::kString && value.size() == 4) {
    const Bytes text = take(reader, static_cast<std::size_t>(std::max(int32_of(value), 0)));
    value.insert(value.end(), text.begin(), text.end());
  }
  return value;
}

}  // namespace

std::vector<MessagePart> parts_of(const WireLayout& layout, std::span<const std::uint8_t> bytes) {
  ByteReader reader(bytes);
  reader.take(std::min(kFingerprintBytes, bytes.size()));
  std::vector<MessagePart> parts;
  for (const WireField& field : layout.fields) {
    MessagePart taken{&field, {}};
    const auto count = static_cast<std::size_t>(std::max<std::int64_t>(count_of(field, parts), 0));
    if (field.kind == WireKind::kByte) {
      taken.values.push_back(take(reader, count));
    } else {
      for (std::size_t i = 0; i < count && reader.left() > 0; ++i) {
        taken.values.push_back(take_value(reader, field.kind));
      }
    }
    parts.push_back(std::move(taken));
  }
  return parts;
}

Bytes message_of(const WireLayout& layout, const std::vector<MessagePart>& parts) {
  Bytes bytes;
  put_big_endian(bytes, static_cast<std::uint64_t>(layout.fingerprint()), 8);
  for (const MessagePart& part : parts) {
    for (const Bytes& value : part.values) bytes.insert(bytes.end(), value.begin(), value.end());
  }
  return bytes;
}

void set_length(std::vector<MessagePart>& parts, const MessagePart& count, std::size_t length) {
  const std::string_view counted = count.field->name;
  for (MessagePart& part : parts) {
    if (part.field->name == counted) {
      Bytes value;
      put_big_endian(value, length, 4);
      part.values = {value};
    } else if (part.field->count_field == counted) {
      if (part.field->kind == WireKind::kByte) {
        part.values.resize(1);
        part.values.front().resize(length);
        continue;
      }
      Bytes zeros(size_of(part.field->kind));
      if (part.field->kind == WireKind::kString) zeros = {0, 0, 0, 1, 0};
      part.values.resize(length, part.values.empty() ? zeros : Bytes(part.values.back()));
    }
  }
}

bool is_count(const WireLayout& layout, const WireField& field) {
  return std::any_of(layout.fields.begin(), layout.fields.end(),
                     [&](const WireField& other) { return other.count_field == field.name; });
}

void put_big_endian(Bytes& bytes, std::uint64_t value, int size) {
  for (int i = size - 1; i >= 0; --i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

}  // namespace puck
