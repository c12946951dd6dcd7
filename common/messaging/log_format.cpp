#include "common/messaging/log_format.h"

#include <algorithm>

#include "common/messaging/byte_reader.h"

namespace puck {
namespace {

template <typename Whole>
void put(std::span<std::uint8_t> to, Whole value) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    to[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >>
                                      (8 * (sizeof value - 1 - i)));
  }
}

}  // namespace

std::optional<LogHeader> parse_log_header(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kLogHeaderBytes) return std::nullopt;
  if (!std::equal(kLogMark.begin(), kLogMark.end(), bytes.begin())) return std::nullopt;
  ByteReader reader(bytes);
  reader.take(kLogMark.size());
  LogHeader header;
  header.number = reader.whole<std::int64_t>();
  header.utime = reader.whole<std::int64_t>();
  // Negative lengths become huge ones.
  header.channel_bytes = static_cast<std::uint32_t>(reader.whole<std::int32_t>());
  header.message_bytes = static_cast<std::uint32_t>(reader.whole<std::int32_t>());
  if (header.channel_bytes < 1 || header.channel_bytes > kLogMaxChannelBytes) return std::nullopt;
  if (header.message_bytes > kLogMaxMessageBytes) return std::nullopt;
  return header;
}

void put_log_header(std::span<std::uint8_t> to, const LogHeader& header) {
  std::copy(kLogMark.begin(), kLogMark.end(), to.begin());
  put(to.subspan(4), header.number);
  put(to.subspan(12), header.utime);
  put(to.subspan(20), static_cast<std::uint32_t>(header.channel_bytes));
  put(to.subspan(24), static_cast<std::uint32_t>(header.message_bytes));
}

void put_log_number(std::span<std::uint8_t> record, std::int64_t number) {
  put(record.subspan(4), number);
}

void put_log_record(std::span<std::uint8_t> to, const LogHeader& header, std::string_view channel,
                    std::span<const std::uint8_t> message) {
  put_log_header(to, header);
  const auto names = std::copy(channel.begin(), channel.end(),
                               to.begin() + static_cast<std::ptrdiff_t>(kLogHeaderBytes));
  std::copy(message.begin(), message.end(), names);
}

}  // namespace puck
