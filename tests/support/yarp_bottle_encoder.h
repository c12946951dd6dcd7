#pragma once

#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace puck {

/// A message of a camera's port: its stamp, and the bottle as it is on the wire.
struct WireBottle {
  long long count = 0;
  double time_s = 0;
  std::string bytes;
};

/// Writes the bottles that a line of a YARP text log was made of, independently of common/io.
namespace wire_bottle {

inline std::string int32(std::int64_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  std::string bytes(4, '\0');
  for (int i = 0; i < 4; ++i) bytes[static_cast<std::size_t>(i)] = static_cast<char>(word >> 8 * i);
  return bytes;
}

inline std::string string_item(const std::string& text) {
  return int32(4) + int32(static_cast<std::int64_t>(text.size())) + text;
}

inline std::string list_of(std::size_t items) {
  return int32(256) + int32(static_cast<std::int64_t>(items));
}

inline std::string int_list(const std::vector<std::int64_t>& values) {
  std::string bytes = int32(257) + int32(static_cast<std::int64_t>(values.size()));
  for (const std::int64_t value : values) bytes += int32(value);
  return bytes;
}

inline std::string unescaped(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char byte = text[i];
    if (byte == '\\') {
      byte = text.at(++i);
      if (byte == 'n') byte = '\n';
      if (byte == 'r') byte = '\r';
      if (byte == '0') byte = '\0';
    }
    bytes += byte;
  }
  return bytes;
}

/// `AE (…)` or `AE duration "…"`, with one or two times before it.
inline WireBottle of_log_line(const std::string& line) {
  const std::size_t tag = line.find(" AE ");
  if (tag == std::string::npos) throw std::runtime_error("no tag in " + line.substr(0, 60));
  WireBottle bottle;
  std::istringstream(line.substr(0, tag)) >> bottle.count >> bottle.time_s;
  const std::string content = line.substr(tag + 4);
  if (content.front() == '(') {
    std::istringstream numbers(content.substr(1));
    std::vector<std::int64_t> values;
    for (std::int64_t value = 0; numbers >> value;) values.push_back(value);
    bottle.bytes = list_of(2) + string_item("AE") + int_list(values);
    return bottle;
  }
  const std::size_t open = content.find('"');
  const std::size_t close = content.rfind('"');
  bottle.bytes = list_of(3) + string_item("AE") + int32(1) + int32(std::stoll(content)) +
                 string_item(unescaped(content.substr(open + 1, close - open - 1)));
  return bottle;
}

/// All lines of a log.
inline std::vector<WireBottle> of_log(const std::string& text) {
  std::vector<WireBottle> bottles;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) bottles.push_back(of_log_line(line));
  return bottles;
}

}  // namespace wire_bottle
}  // namespace puck
