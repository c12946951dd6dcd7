#include "common/yarp/text_lines.h"

#include <algorithm>

#include "common/yarp/yarp_error.h"

namespace puck {

void TextLines::feed(std::span<const std::uint8_t> bytes) {
  text_.append(bytes.begin(), bytes.end());
}

std::optional<std::string> TextLines::next() {
  const std::size_t end = text_.find('\n');
  if (std::min(end, text_.size()) > kMostBytes) throw YarpError("it sent a line without an end");
  const auto is_control = [](unsigned char c) {
    return (c < 0x20 && c != '\r' && c != '\t') || c == 0x7f;
  };
  const auto last = text_.begin() + static_cast<std::ptrdiff_t>(std::min(end, text_.size()));
  if (std::any_of(text_.begin(), last, is_control)) {
    throw YarpError("it sent a line that is not text: " + in_quotes({text_.begin(), last}));
  }
  if (end == std::string::npos) return std::nullopt;
  std::string line = text_.substr(0, end);
  text_.erase(0, end + 1);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

}  // namespace puck
