#include "tools/spy/message_lines.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "common/messaging/event_packing.h"
#include "common/messaging/message_fields.h"
#include "common/messaging/wire_layout.h"
#include "tools/spy/short_text.h"

namespace puck {
namespace {

constexpr std::size_t kNameWidth = 24;
constexpr std::size_t kMaxEvents = 256;

std::size_t value_width(std::size_t width) {
  return width > kNameWidth + 8 ? width - kNameWidth - 1 : 8;
}

void add_line(std::vector<std::string>& lines, const std::string& name, const std::string& value) {
  lines.push_back(fit_left(name, std::max(kNameWidth, name.size())) + ' ' + value);
}

/// Collects the values of an array until a line is full.
class ArrayLines {
 public:
  ArrayLines(std::vector<std::string>& lines, std::size_t width)
      : lines_(lines), room_(value_width(width)) {}

  void add(std::string_view name, std::size_t index, std::string_view value) {
    if (index == 0 || text_.size() + value.size() + 2 > room_) flush();
    if (text_.empty()) name_ = std::string(name) + '[' + std::to_string(index) + ']';
    if (!text_.empty()) text_ += "  ";
    text_ += value;
  }
  void flush() {
    if (!text_.empty()) add_line(lines_, name_, text_);
    text_.clear();
  }

 private:
  std::vector<std::string>& lines_;
  std::size_t room_;
  std::string name_;
  std::string text_;
};

void add_events(std::vector<std::string>& lines, std::span<const std::uint8_t> bytes) {
  EventPacketView view;
  decode_checked(bytes, view);
  EventPacket packet;
  unpack(view, packet);
  const std::size_t shown = std::min(packet.events.size(), kMaxEvents);
  for (std::size_t i = 0; i < shown; ++i) {
    const Event& event = packet.events[i];
    add_line(lines, "event[" + std::to_string(i) + ']',
             '+' + std::to_string(event.offset_us) + " us  x " + std::to_string(event.x) + "  y " +
                 std::to_string(event.y) + (event.polarity ? "  brighter" : "  darker"));
  }
  if (shown < packet.events.size()) {
    lines.push_back("... and " + std::to_string(packet.events.size() - shown) + " more events");
  }
}

/// The name of a number's meaning, if it has one.
std::string meaning_of(Channel channel, std::string_view name, std::string_view value) {
  const auto fields = wire_layout(channel).fields;
  const auto field = std::find_if(fields.begin(), fields.end(),
                                  [&](const WireField& known) { return known.name == name; });
  std::size_t place = 0;
  const bool is_whole =
      std::from_chars(value.data(), value.data() + value.size(), place).ec == std::errc();
  if (!is_whole || field == fields.end() || place >= field->meanings.size()) {
    return std::string(value);
  }
  return std::string(field->meanings[place]);
}

}  // namespace

void add_field(std::vector<std::string>& lines, const std::string& name, std::string value,
               std::size_t width) {
  value = plain_text(value);
  const std::size_t room = value_width(width);
  add_line(lines, name, value.substr(0, room));
  for (std::size_t at = room; at < value.size(); at += room) {
    add_line(lines, "", value.substr(at, room));
  }
}

std::vector<std::string> message_lines(Channel channel, std::span<const std::uint8_t> bytes,
                                       std::size_t width) {
  std::vector<std::string> lines;
  ArrayLines array(lines, width);
  visit_fields(
      channel, bytes,
      [&](std::string_view name, std::optional<std::size_t> index, std::string_view value) {
        if (index) return array.add(name, *index, plain_text(value));
        array.flush();
        // Shown decoded instead.
        if (channel == Channel::kEvents && name == "data") return;
        add_field(lines, std::string(name), meaning_of(channel, name, value), width);
      });
  array.flush();
  if (channel == Channel::kEvents) add_events(lines, bytes);
  return lines;
}

}  // namespace puck
