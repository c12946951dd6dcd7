#include "common/io/text_decoder.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include "common/io/event_sink.h"
#include "common/io/reader_warnings.h"
#include "common/io/text_format.h"
#include "common/io/trimmed.h"

namespace puck {
namespace {

// A longer line is no event.
constexpr std::size_t kLongestTextLine = 4096;
// Late events of one camera are later than that by far less.
constexpr std::int64_t kJoinedBackUs = 100'000;

class TextDecoder final : public EventDecoder {
 public:
  TextDecoder(std::string name, TextFormat format, SensorSize sensor, std::int64_t reorder_us)
      : name_(std::move(name)),
        format_(std::move(format)),
        sink_(sensor, reorder_us),
        line_number_(format_.header_lines) {}

  std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet,
                     std::size_t max_events) override {
    sink_.begin(packet, max_events);
    const auto* const start = reinterpret_cast<const char*>(bytes.data());
    std::size_t used = 0;
    while (sink_.has_room() && used < bytes.size()) {
      const char* const line = start + used;
      const void* const found = std::memchr(line, '\n', bytes.size() - used);
      const auto length = found == nullptr
                              ? bytes.size() - used
                              : static_cast<std::size_t>(static_cast<const char*>(found) - line);
      used += length;
      if (found == nullptr || !partial_.empty()) partial_.append(line, length);
      if (partial_.size() > kLongestTextLine) fail(partial_);
      if (found == nullptr) break;
      ++used;
      ++line_number_;
      take_line(partial_.empty() ? std::string_view(line, length) : partial_);
      partial_.clear();
    }
    return used;
  }

  void finish() override {
    EventPacket nothing;
    sink_.begin(nothing, 0);
    TextEvent event;
    // A number at the end of the last line may be cut.
    const bool is_whole =
        parse_text_event(partial_, format_, event) &&
        (format_.columns[TextFormat::kTime] + 1 < format_.column_count || event.t_us >= newest_us_);
    if (is_whole) {
      sink_.append({event.t_us}, event.x, event.y, event.brighter);
    } else if (const auto content = trimmed(partial_); !content.empty() && !is_comment(content)) {
      sink_.counters().truncated_bytes += static_cast<std::int64_t>(partial_.size());
    }
    partial_.clear();
  }

  bool has_backlog() const override { return sink_.has_backlog(); }
  const EventCounters& counters() const override { return sink_.counters(); }
  Timestamp newest() const override { return sink_.newest(); }

  std::vector<std::string> notes() const override {
    if (!large_loss(counters()) || longest_back_us_ < kJoinedBackUs) return {};
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  "the times go back at line %lld by %.6g s: are two recordings joined? Split the "
                  "file at that line",
                  static_cast<long long>(longest_back_line_),
                  static_cast<double>(longest_back_us_) * 1e-6);
    return {text.data()};
  }

 private:
  static bool is_comment(std::string_view content) {
    return content.front() == '#' || content.front() == '%';
  }

  void take_line(std::string_view line) {
    TextEvent event;
    if (parse_text_event(line, format_, event)) {
      if (newest_us_ - event.t_us > longest_back_us_) {
        longest_back_us_ = newest_us_ - event.t_us;
        longest_back_line_ = line_number_;
      }
      newest_us_ = std::max(newest_us_, event.t_us);
      sink_.append({event.t_us}, event.x, event.y, event.brighter);
      return;
    }
    const std::string_view content = trimmed(line);
    if (!content.empty() && !is_comment(content)) fail(content);
  }

  [[noreturn]] void fail(std::string_view line) const {
    constexpr std::size_t kLongestQuote = 60;
    throw EventFileError(name_ + ":" + std::to_string(line_number_) + ": expected `" +
                         format_.description +
                         "` with a time of 0 or more, whole pixels, and a polarity of 1, 0 or -1, "
                         "got \"" +
                         std::string(line.substr(0, kLongestQuote)) + "\"");
  }

  std::string name_;
  TextFormat format_;
  EventSink sink_;
  std::string partial_;  // A line whose end has not come.
  std::int64_t line_number_;
  std::int64_t newest_us_ = 0;
  std::int64_t longest_back_us_ = 0;
  std::int64_t longest_back_line_ = 0;
};

}  // namespace

std::optional<StreamStart> begin_text(const StreamHead& head) {
  auto format = find_text_format(head);
  if (!format) return std::nullopt;
  StreamStart start{.header_bytes = format->header_bytes, .encoding = "text"};
  start.stated_sensor = format->sensor;
  start.repeat = format->repeat;
  start.notes = format->notes;
  start.make_decoder = [name = head.name, format = *format](SensorSize sensor,
                                                            std::int64_t reorder_us) {
    return std::make_unique<TextDecoder>(name, format, sensor, reorder_us);
  };
  return start;
}

}  // namespace puck
