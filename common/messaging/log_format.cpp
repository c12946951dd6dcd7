#include "common/messaging/log_format.h"

#include <algorithm>

#include "common/messaging/byte_order.h"
#include "common/messaging/byte_reader.h"

namespace puck {
std::optional<LogHeader> parse_log_header(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kLogHeaderBytes) return std::nullopt;
  if (!std::equal(kLogMark.begin(), kLogMark.end(), bytes.begin())) return std::nullopt;
  ByteReader reader(bytes);
  reader.take(kLogMark.size());
  LogHeader header;
  header.number = reader.whole<std::int64_t>();
  header.utime = reader.whole<std::int64_t>();
  // Unsigned: negative lengths become huge ones.
  header.channel_bytes = static_cast<std::uint32_t>(reader.whole<std::int32_t>());
  header.message_bytes = static_cast<std::uint32_t>(reader.whole<std::int32_t>());
  if (header.channel_bytes < 1 || header.channel_bytes > kLogMaxChannelBytes) return std::nullopt;
  if (header.message_bytes > kLogMaxMessageBytes) return std::nullopt;
  return header;
}

void put_log_header(std::span<std::uint8_t> to, const LogHeader& header) {
  std::copy(kLogMark.begin(), kLogMark.end(), to.begin());
  put_log_number(to, header.number);
  put_big_endian(static_cast<std::uint64_t>(header.utime), to.subspan(12).data());
  put_big_endian(static_cast<std::uint32_t>(header.channel_bytes), to.subspan(20).data());
  put_big_endian(static_cast<std::uint32_t>(header.message_bytes), to.subspan(24).data());
}

void put_log_number(std::span<std::uint8_t> record, std::int64_t number) {
  put_big_endian(static_cast<std::uint64_t>(number), record.subspan(4).data());
}

void put_log_record(std::span<std::uint8_t> to, const LogHeader& header, std::string_view channel,
                    std::span<const std::uint8_t> message) {
  put_log_header(to, header);
  const auto names = std::copy(channel.begin(), channel.end(),
                               to.begin() + static_cast<std::ptrdiff_t>(kLogHeaderBytes));
  std::copy(message.begin(), message.end(), names);
}

}  // namespace puck
