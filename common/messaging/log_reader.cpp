#include <algorithm>

#include "common/messaging/log_file.h"

// LCM's own reader ends at the first damage without an error, hence this one.

namespace puck {
namespace {

constexpr std::int64_t kSearchedForTheFirst = std::int64_t{1} << 20;
constexpr const char* kCutOff = "the log ends within a message";

bool is_printable(std::span<const std::uint8_t> text) {
  return std::all_of(text.begin(), text.end(), [](std::uint8_t c) { return c > 0x20 && c < 0x7f; });
}

}  // namespace

LogReader::LogReader(const std::filesystem::path& path) : bytes_(path) {
  if (bytes_.size() == 0 || parse_log_header(bytes_.at(0, kLogHeaderBytes))) return;
  // The first message may be damaged, or the only one and cut off.
  if (message_may_begin(0)) return;
  for (std::int64_t place = 1; place < kSearchedForTheFirst; ++place) {
    place = bytes_.find_mark(place, kSearchedForTheFirst);
    if (place < kSearchedForTheFirst && message_begins(place)) return;
  }
  throw LogFileError(path.string() + ": is not an LCM log: it does not begin with a message");
}

bool LogReader::next(LogRecord& record) {
  while (offset_ < bytes_.size()) {
    const auto header = parse_log_header(bytes_.at(offset_, kLogHeaderBytes));
    if (!header) {
      if (offset_ + static_cast<std::int64_t>(kLogHeaderBytes) > bytes_.size()) {
        skip_damage(kCutOff);
      } else if (message_may_begin(offset_)) {
        skip_damage("a message has an impossible length");
      } else {
        skip_damage("no message begins");
      }
      continue;
    }
    if (auto problem = find_problem(*header)) {
      skip_damage(std::move(*problem));
      continue;
    }
    const auto whole = bytes_.at(offset_, header->record_bytes());
    if (whole.size() < header->record_bytes()) {  // The file was cut meanwhile.
      skip_damage(kCutOff);
      continue;
    }
    const auto channel = whole.subspan(kLogHeaderBytes, header->channel_bytes);
    const auto message = whole.subspan(kLogHeaderBytes + header->channel_bytes);
    record.number = header->number;
    record.utime = header->utime;
    record.channel.assign(channel.begin(), channel.end());
    record.bytes.assign(message.begin(), message.end());
    record.offset = offset_;
    offset_ += static_cast<std::int64_t>(header->record_bytes());
    return true;
  }
  return false;
}

// A damaged length may still be plausible. The numbers of the neighbours reveal it: the message
// with the next number must begin at the end of this one.
std::optional<std::string> LogReader::find_problem(const LogHeader& header) {
  constexpr int kMostMarksInside = 16;  // Bound for a log forged to slow the reader.
  const std::int64_t end = offset_ + static_cast<std::int64_t>(header.record_bytes());
  if (end > bytes_.size()) return kCutOff;
  const auto follows = [&](std::int64_t place) {
    const auto next = parse_log_header(bytes_.peek(place, kLogHeaderBytes));
    // Unsigned, since the numbers may have any value.
    return next && static_cast<std::uint64_t>(next->number) ==
                       static_cast<std::uint64_t>(header.number) + 1;
  };
  std::int64_t inside = offset_ + static_cast<std::int64_t>(kLogHeaderBytes);
  for (int i = 0; i < kMostMarksInside; ++i, ++inside) {
    inside = bytes_.find_mark(inside, end);
    if (inside == end) break;
    if (follows(inside) && message_begins(inside)) {
      return "the length of a message points past the start of the next one";
    }
  }
  if (end == bytes_.size() || message_may_begin(end)) return std::nullopt;
  const std::int64_t next = next_message_from(end, behind_end_);
  if (next < bytes_.size() && follows(next)) {
    return "bytes between the end of a message and the start of the next one";
  }
  return std::nullopt;
}

bool LogReader::message_may_begin(std::int64_t offset) {
  return std::ranges::equal(bytes_.peek(offset, kLogMark.size()), kLogMark);
}

bool LogReader::message_begins(std::int64_t offset) {
  const auto header = parse_log_header(bytes_.at(offset, kLogHeaderBytes));
  if (!header) return false;
  if (offset + static_cast<std::int64_t>(header->record_bytes()) > bytes_.size()) return false;
  const auto channel =
      bytes_.at(offset + static_cast<std::int64_t>(kLogHeaderBytes), header->channel_bytes);
  return is_printable(channel);
}

std::int64_t LogReader::next_message_from(std::int64_t offset, Searched& searched) {
  if (offset >= searched.from && offset <= searched.to) return searched.to;
  std::int64_t place = bytes_.find_mark(offset, bytes_.size());
  while (place < bytes_.size() && !message_begins(place)) {
    place = bytes_.find_mark(place + 1, bytes_.size());
  }
  searched = {offset, std::min(place, bytes_.size())};
  return searched.to;
}

void LogReader::skip_damage(std::string why) {
  const std::int64_t from = offset_;
  offset_ = next_message_from(from + 1, behind_damage_);
  bytes_skipped_ += offset_ - from;
  if (!damage_) damage_ = why + " at byte " + std::to_string(from);
  if (on_damage_) on_damage_({from, offset_ - from, std::move(why)});
}

}  // namespace puck
