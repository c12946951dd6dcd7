#include "common/messaging/message_fields.h"

#include <array>
#include <charconv>
#include <string>
#include <vector>

#include "common/messaging/byte_reader.h"
#include "common/messaging/wire_layout.h"

namespace puck {
namespace {

/// Walks a message along its layout. Remembers integers only, which include the counts of later
/// arrays.
class FieldWalk {
 public:
  FieldWalk(const WireLayout& layout, std::span<const std::uint8_t> bytes,
            const FieldVisitor& visit)
      : layout_(layout), reader_(bytes), visit_(visit), values_(layout.fields.size()) {}

  void run() {
    reader_.take(kFingerprintBytes);
    for (std::size_t i = 0; i < layout_.fields.size(); ++i) visit_field(i);
  }

 private:
  void visit_field(std::size_t place) {
    const WireField& field = layout_.fields[place];
    const std::size_t count = count_of(field);
    if (field.kind == WireKind::kByte) return visit_bytes(field, count);
    const bool is_array = !field.count_field.empty() || field.fixed_count != 1;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view value = read_value(field.kind, values_[place]);
      visit_(field.name, is_array ? std::optional(i) : std::nullopt, value);
    }
  }

  std::size_t count_of(const WireField& field) const {
    const auto place = place_of_count(layout_, field);
    return static_cast<std::size_t>(place ? values_[*place] : field.fixed_count);
  }

  std::string_view read_value(WireKind kind, std::int64_t& whole) {
    switch (kind) {
      case WireKind::kString: {
        const auto length = static_cast<std::size_t>(reader_.whole<std::int32_t>());
        const auto text = reader_.take(length).first(length - 1);  // Without its NUL.
        return {reinterpret_cast<const char*>(text.data()), text.size()};
      }
      case WireKind::kDouble:
        return written(reader_.real());
      case WireKind::kInt8:
      case WireKind::kBoolean:
        whole = reader_.whole<std::int8_t>();
        break;
      case WireKind::kInt32:
        whole = reader_.whole<std::int32_t>();
        break;
      case WireKind::kInt64:
        whole = reader_.whole<std::int64_t>();
        break;
      case WireKind::kByte:
        break;
    }
    return written(whole);
  }

  template <typename Number>
  std::string_view written(Number number) {
    const auto end = std::to_chars(digits_.data(), digits_.data() + digits_.size(), number).ptr;
    return {digits_.data(), static_cast<std::size_t>(end - digits_.data())};
  }

  void visit_bytes(const WireField& field, std::size_t count) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string hexadecimal(2 * count, '0');
    char* digit = hexadecimal.data();
    for (const std::uint8_t byte : reader_.take(count)) {
      *digit++ = kDigits[byte >> 4];
      *digit++ = kDigits[byte & 15];
    }
    visit_(field.name, std::nullopt, hexadecimal);
  }

  const WireLayout& layout_;
  ByteReader reader_;
  const FieldVisitor& visit_;
  std::vector<std::int64_t> values_;
  std::array<char, 32> digits_{};
};

}  // namespace

void visit_fields(Channel channel, std::span<const std::uint8_t> bytes, const FieldVisitor& visit) {
  FieldWalk(wire_layout(channel), bytes, visit).run();
}

}  // namespace puck
