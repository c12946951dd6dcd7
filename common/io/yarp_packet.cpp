#include "common/io/yarp_packet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "common/io/parse_number.h"

namespace puck {
namespace {

constexpr std::string_view kBlanks = " \t\r";

bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }
bool is_blank(char c) { return kBlanks.find(c) != std::string_view::npos; }

// Steps through the values of a line: words, numbers, `( … )` and `" … "`.
class ValueCursor {
 public:
  explicit ValueCursor(std::string_view text) : rest_(text) {}

  /// The next word; empty before a list or a string, and at the end.
  std::string_view take_word() {
    skip_blanks();
    std::size_t length = 0;
    while (length < rest_.size() && !is_blank(rest_[length]) && rest_[length] != '(' &&
           rest_[length] != '"') {
      ++length;
    }
    return take(length);
  }

  char next() {
    skip_blanks();
    return rest_.empty() ? '\0' : rest_.front();
  }

  /// Steps over the list that is next and returns its content without the parentheses. `is_closed`
  /// is false if the line ends before the list.
  std::string_view take_list(bool& is_closed) {
    rest_.remove_prefix(1);
    int depth = 1;
    std::size_t length = 0;
    for (; length < rest_.size(); ++length) {
      if (rest_[length] == '(') ++depth;
      if (rest_[length] == ')' && --depth == 0) break;
    }
    is_closed = length < rest_.size();
    const std::string_view list = take(length);
    if (is_closed) rest_.remove_prefix(1);
    return list;
  }

  /// Steps over the string that is next and returns its content without the quotes, still escaped.
  std::string_view take_string(bool& is_closed) {
    rest_.remove_prefix(1);
    std::size_t length = 0;
    while (length < rest_.size() && rest_[length] != '"') length += rest_[length] == '\\' ? 2 : 1;
    is_closed = length < rest_.size();
    const std::string_view text = take(std::min(length, rest_.size()));
    if (is_closed) rest_.remove_prefix(1);
    return text;
  }

 private:
  void skip_blanks() {
    while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
  }
  std::string_view take(std::size_t length) {
    const std::string_view taken = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return taken;
  }

  std::string_view rest_;
};

// Reads `sequence time [time]` and the tag behind it. A second time is the time of receipt.
bool take_envelope(ValueCursor& cursor, double& host_time_s, std::string_view& tag) {
  std::int64_t sequence = 0;
  if (!parse_number(cursor.take_word(), sequence)) return false;
  if (!parse_number(cursor.take_word(), host_time_s) || !(host_time_s >= 0) ||
      host_time_s > kLatestYarpTime_s) {
    return false;
  }
  tag = cursor.take_word();
  double received_s = 0;
  if (parse_number(tag, received_s)) tag = cursor.take_word();
  return is_yarp_tag(tag);
}

// Parses a 32-bit number, signed or unsigned.
bool parse_word(std::string_view text, std::uint32_t& word) {
  std::int64_t value = 0;
  if (!parse_number(text, value) || value < std::numeric_limits<std::int32_t>::min() ||
      value > std::numeric_limits<std::uint32_t>::max()) {
    return false;
  }
  word = static_cast<std::uint32_t>(value);
  return true;
}

// Reads the numbers of a list in pairs; skips a pair with a malformed number.
void read_list(std::string_view list, bool is_closed, YarpPacket& packet) {
  std::array<std::uint32_t, 2> pair{};
  std::size_t in_pair = 0;
  bool is_pair_good = true;
  std::size_t complete = 0;  // Length of the list up to the end of its last whole pair.
  std::size_t at = 0;
  while ((at = list.find_first_not_of(kBlanks, at)) != std::string_view::npos) {
    const std::size_t end = std::min(list.find_first_of(kBlanks, at), list.size());
    // In a list that was cut, the last number may lack digits.
    if (end == list.size() && !is_closed) break;
    is_pair_good = parse_word(list.substr(at, end - at), pair[in_pair]) && is_pair_good;
    at = end;
    if (++in_pair < pair.size()) continue;
    if (is_pair_good) {
      packet.words.insert(packet.words.end(), pair.begin(), pair.end());
    } else {
      ++packet.malformed_values;
    }
    in_pair = 0;
    is_pair_good = true;
    complete = end;
  }
  if (!is_closed) {
    packet.cut_bytes += static_cast<std::int64_t>(list.size() - complete);
  } else if (in_pair > 0) {
    ++packet.malformed_values;
  }
}

// YARP escapes line ends, NUL, quotes and backslashes.
char unescaped(char escape) {
  switch (escape) {
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case '0':
      return '\0';
    default:
      return escape;
  }
}

// Reads the bytes of a string, four to a word, least significant first.
void read_string(std::string_view text, bool is_closed, YarpPacket& packet) {
  std::uint32_t word = 0;
  int filled = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char byte = text[i];
    if (byte == '\\') {
      // The string was cut within an escape.
      if (++i == text.size()) break;
      byte = unescaped(text[i]);
    }
    word |= std::uint32_t{static_cast<unsigned char>(byte)} << (8 * filled);
    if (++filled < 4) continue;
    packet.words.push_back(word);
    word = 0;
    filled = 0;
  }
  if (filled == 0) return;
  if (is_closed) {
    ++packet.malformed_values;
  } else {
    packet.cut_bytes += filled;
  }
}

// Reads what follows the tag of events: a list, or a duration and a string. False if it was cut.
bool read_events(ValueCursor& cursor, YarpPacket& packet) {
  bool is_closed = true;
  if (cursor.next() == '(') {
    const std::string_view list = cursor.take_list(is_closed);
    read_list(list, is_closed, packet);
    return is_closed;
  }
  std::int64_t duration_us = 0;
  const std::string_view duration = cursor.take_word();
  const bool has_duration = parse_number(duration, duration_us) && duration_us >= 0;
  if (!has_duration || cursor.next() != '"') {
    ++packet.malformed_values;
    return true;
  }
  packet.duration_us = duration_us;
  packet.is_bytes = true;
  const std::string_view text = cursor.take_string(is_closed);
  read_string(text, is_closed, packet);
  return is_closed;
}

// Skips the values up to the next tag, which are one record of other data.
void skip_record(ValueCursor& cursor) {
  bool is_closed = true;
  while (true) {
    const char next = cursor.next();
    if (next == '(') {
      cursor.take_list(is_closed);
    } else if (next == '"') {
      cursor.take_string(is_closed);
    } else if (next == '\0' || is_capital(next)) {
      return;
    } else {
      cursor.take_word();
    }
  }
}

}  // namespace

bool is_yarp_tag(std::string_view word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), is_capital);
}

bool is_yarp_log(std::string_view head) {
  // The first lines may be damaged.
  while (!head.empty()) {
    const std::size_t end = std::min(head.find('\n'), head.size() - 1);
    ValueCursor cursor(head.substr(0, end));
    double host_time_s = 0;
    std::string_view tag;
    if (take_envelope(cursor, host_time_s, tag)) {
      double number = 0;
      if (cursor.next() == '(' || cursor.next() == '"') return true;
      if (parse_number(cursor.take_word(), number) && cursor.next() == '"') return true;
    }
    head.remove_prefix(end + 1);
  }
  return false;
}

bool parse_yarp_packet(std::string_view line, YarpPacket& packet) {
  YarpPacket empty;
  empty.words = std::move(packet.words);
  empty.words.clear();
  packet = std::move(empty);
  ValueCursor cursor(line);
  std::string_view tag;
  if (!take_envelope(cursor, packet.host_time_s, tag)) return false;
  bool has_events = false;
  for (; !tag.empty(); tag = cursor.take_word()) {
    if (tag != kYarpEventTag || has_events) {
      ++packet.other_records;
      skip_record(cursor);
      continue;
    }
    has_events = true;
    packet.is_cut = !read_events(cursor, packet);
  }
  return true;
}

}  // namespace puck
