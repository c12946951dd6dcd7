#include "common/messaging/wire_layout.h"

#include <algorithm>
#include <array>

#include "puck/wire_layouts.hpp"

namespace puck {
namespace {

std::size_t most_count(const WireLayout& layout, const WireField& field) {
  const auto place = place_of_count(layout, field);
  return static_cast<std::size_t>(place ? layout.fields[*place].max : field.fixed_count);
}

}  // namespace

std::optional<std::size_t> place_of_count(const WireLayout& layout, const WireField& field) {
  if (field.count_field.empty()) return std::nullopt;
  const auto found =
      std::find_if(layout.fields.begin(), layout.fields.end(),
                   [&](const WireField& other) { return other.name == field.count_field; });
  return static_cast<std::size_t>(found - layout.fields.begin());
}

std::size_t wire_bytes(WireKind kind) {
  switch (kind) {
    case WireKind::kInt8:
    case WireKind::kBoolean:
    case WireKind::kByte:
      return 1;
    case WireKind::kInt32:
      return 4;
    case WireKind::kInt64:
    case WireKind::kDouble:
      return 8;
    case WireKind::kString:
      return 5;
  }
  return 0;
}

const WireLayout& wire_layout(Channel channel) {
  return kLayouts[static_cast<std::size_t>(channel)];
}

std::size_t most_message_bytes(Channel channel) {
  const WireLayout& layout = wire_layout(channel);
  std::size_t bytes = kFingerprintBytes;
  for (const WireField& field : layout.fields) {
    const std::size_t text =
        field.kind == WireKind::kString ? static_cast<std::size_t>(field.max) : 0;
    bytes += most_count(layout, field) * (wire_bytes(field.kind) + text);
  }
  return bytes;
}

}  // namespace puck
