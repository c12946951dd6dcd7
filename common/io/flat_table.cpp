#include "common/io/flat_table.h"

#include <stdexcept>
#include <string>

namespace puck {

FlatTable::FlatTable(std::span<const std::byte> buffer, std::string_view id) : buffer_(buffer) {
  const std::size_t size = load<std::uint32_t>(0);
  buffer_ = buffer.subspan(4);
  if (size > buffer_.size()) {
    throw std::invalid_argument("a buffer of " + std::to_string(size) + " bytes ends after " +
                                std::to_string(buffer_.size()));
  }
  buffer_ = buffer_.first(size);
  check(4, id.size());
  const std::string_view found(reinterpret_cast<const char*>(buffer_.data()) + 4, id.size());
  if (found != id) {
    throw std::invalid_argument("a buffer that begins \"" + std::string(found) + "\", expected " +
                                std::string(id));
  }
  table_ = load<std::uint32_t>(0);
  // The offset is signed and subtracted; whatever wraps around is beyond the buffer.
  const auto back = static_cast<std::int32_t>(load<std::uint32_t>(table_));
  fields_ = table_ - static_cast<std::size_t>(std::int64_t{back});
  fields_bytes_ = load<std::uint16_t>(fields_);
  check(fields_, fields_bytes_);
}

std::span<const std::byte> FlatTable::list(std::size_t field, std::size_t element_bytes) const {
  const std::size_t offset = field_offset(field);
  if (offset == 0) return {};
  const std::size_t start = offset + load<std::uint32_t>(offset);
  const std::size_t bytes = load<std::uint32_t>(start) * element_bytes;
  check(start + 4, bytes);
  return buffer_.subspan(start + 4, bytes);
}

void FlatTable::check(std::size_t offset, std::size_t bytes) const {
  if (offset > buffer_.size() || bytes > buffer_.size() - offset) {
    throw std::invalid_argument("an offset of " + std::to_string(offset) + " in a buffer of " +
                                std::to_string(buffer_.size()) + " bytes");
  }
}

std::size_t FlatTable::field_offset(std::size_t field) const {
  const std::size_t place = 4 + 2 * field;
  if (place + 2 > fields_bytes_) return 0;
  const std::size_t offset = load<std::uint16_t>(fields_ + place);
  return offset == 0 ? 0 : table_ + offset;
}

}  // namespace puck
