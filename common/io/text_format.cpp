#include "common/io/text_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <system_error>

#include "common/io/number_limits.h"
#include "common/io/parse_number.h"
#include "common/io/text_unit.h"
#include "common/io/trimmed.h"

namespace puck {
namespace {

constexpr std::string_view kAnySeparator = " \t,;";
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr std::size_t kMostColumns = 64;

bool is_in(char character, std::string_view set) {
  return set.find(character) != std::string_view::npos;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  const bool any = separator == '\0';
  const std::string_view separators = any ? kAnySeparator : std::string_view(&separator, 1);
  std::string_view rest = trimmed(line);
  while (fields.size() < kMostColumns) {
    const std::size_t end = std::min(rest.find_first_of(separators), rest.size());
    fields.push_back(trimmed(rest.substr(0, end)));
    if (end == rest.size()) break;
    rest.remove_prefix(end + 1);
    while (any && !rest.empty() && is_in(rest.front(), separators)) rest.remove_prefix(1);
  }
  return fields;
}

// Without the quotes around it.
std::string_view unquoted(std::string_view field) {
  const bool is_quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return is_quoted ? trimmed(field.substr(1, field.size() - 2)) : field;
}

// Lower case, without quotes; a size behind `@` goes to `size`.
std::string plain_name(std::string_view field, int& size) {
  std::string name;
  for (const char character : field) {
    if (character == '"' || character == '\'') continue;
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
  }
  const std::size_t at = name.find('@');
  if (at != std::string::npos) {
    parse_number(std::string_view(name).substr(at + 1), size);
    name.erase(at);
  }
  return name;
}

std::optional<TextFormat::Value> value_of_name(std::string_view name) {
  const std::string_view base = name.substr(0, name.find_first_of("_[( "));
  const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), base) != names.end();
  };
  if (is_one_of({"t", "ts", "time", "times", "timestamp", "timestamps"})) return TextFormat::kTime;
  if (is_one_of({"x", "xs", "col", "column"})) return TextFormat::kX;
  if (is_one_of({"y", "ys", "row"})) return TextFormat::kY;
  if (is_one_of({"p", "ps", "pol", "polarity", "polarities", "on", "sign"})) {
    return TextFormat::kPolarity;
  }
  return std::nullopt;
}

/// Reads the beginning of a text, line by line.
class TextStart {
 public:
  explicit TextStart(const StreamHead& head) : head_(head) {
    const std::string& separator = head.options.text_separator;
    if (separator != "auto" && separator.size() != 1) {
      throw EventFileError("the separator must be auto or one character, got \"" + separator +
                           "\"");
    }
    if (separator != "auto") format_.separator = separator.front();
    if (head.options.text_unit != "auto") {
      unit_ = unit_called(head.options.text_unit);
      if (!unit_) {
        throw EventFileError("the time's unit must be auto, s, ms, us or ns, got \"" +
                             head.options.text_unit + "\"");
      }
    }
    set_columns(head.options.text_columns);
  }

  std::optional<TextFormat> format() {
    if (!read_preamble()) return std::nullopt;
    if (!unit_) {
      if (head_.bytes.size() < head_.sample_bytes && !head_.is_all) return std::nullopt;
      unit_ = guess_unit();
    }
    format_.unit = *unit_;
    return format_;
  }

 private:
  // The next whole line; the rest, if it is all. Without one, nothing.
  std::optional<std::string_view> next_line() {
    const std::string_view rest = head_.text().substr(at_);
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos && (!head_.is_all || rest.empty())) return std::nullopt;
    const std::string_view line = rest.substr(0, end);
    at_ += std::min(line.size() + 1, rest.size());
    ++line_number_;
    return line;
  }

  // Stops before the first event. Returns false while it has not come.
  bool read_preamble() {
    if (head_.text().starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
    while (true) {
      format_.header_bytes = at_;
      format_.header_lines = line_number_;
      const auto line = next_line();
      if (!line) return head_.is_all;
      const std::string_view content = trimmed(*line);
      if (content.empty()) continue;
      bool is_complete = true;
      if (content.starts_with("%geometry:")) {
        take_geometry(content);
      } else if (take_size(*line, is_complete)) {
        if (!is_complete) return false;
      } else if (content.front() == '#' || content.front() == '%') {
        const std::size_t start = std::min(content.find_first_not_of("#% "), content.size());
        take_names(content.substr(start), true);
      } else if (!take_names(content, false)) {
        check_event(content, at_ < head_.bytes.size() || head_.text().back() == '\n');
        return true;
      } else {
        if (!format_.repeat.empty()) {
          format_.notes.push_back("line " + std::to_string(line_number_) +
                                  " names the columns again; expected it once, and took this one");
        }
        format_.repeat = content;
      }
    }
  }

  [[noreturn]] void refuse_line(const std::string& why, std::string_view content) const {
    throw EventFileError(head_.name + ":" + std::to_string(line_number_) + ": " + why + ", got \"" +
                         std::string(content.substr(0, 60)) + "\"");
  }

  void take_geometry(std::string_view content) {
    std::string_view text = content.substr(content.find(':') + 1);
    const std::size_t comma = text.find(',');
    SensorSize sensor;
    if (comma == std::string_view::npos ||
        !parse_number(trimmed(text.substr(0, comma)), sensor.width) ||
        !parse_number(trimmed(text.substr(comma + 1)), sensor.height) || !sensor.is_valid()) {
      refuse_line("expected %geometry:WIDTH,HEIGHT with both from 1 to 2048", content);
    }
    if (format_.sensor && *format_.sensor != sensor) {
      refuse_line("expected %geometry once, or the same size again", content);
    }
    if (format_.sensor) {
      format_.notes.push_back("line " + std::to_string(line_number_) +
                              " repeats %geometry; expected it once");
    }
    format_.sensor = sensor;
  }

  // A line with the sensor's width and height alone, before lines of four columns. `is_complete`
  // becomes false while those have not come.
  bool take_size(std::string_view line, bool& is_complete) {
    const auto numbers = split(line, '\0');
    SensorSize sensor;
    if (numbers.size() != 2 || !parse_number(numbers[0], sensor.width) ||
        !parse_number(numbers[1], sensor.height) || !sensor.is_valid()) {
      return false;
    }
    const std::string_view rest = head_.text().substr(at_);
    const std::size_t end = rest.find('\n');
    is_complete = head_.is_all || end != std::string_view::npos;
    if (is_complete &&
        split(rest.substr(0, end), format_.separator).size() != TextFormat::kValues) {
      return false;
    }
    format_.sensor = sensor;
    // Within a line the two numbers prove nothing.
    format_.repeat = "\n" + std::string(line) + "\n";
    return true;
  }

  // One that is no blank and stands in the names as in the line behind them: names and columns of
  // no interest may then contain blanks, or nothing. Else any.
  char shared_separator(std::string_view names) const {
    const std::string_view rest = head_.text().substr(at_);
    const std::string_view next = rest.substr(0, rest.find('\n'));
    const std::size_t first = names.find_first_of(",;\t");
    if (first == std::string_view::npos || next.find(names[first]) == std::string_view::npos) {
      return '\0';
    }
    return names[first];
  }

  // A line of column names; in a comment, of those four alone.
  bool take_names(std::string_view content, bool is_comment) {
    std::array<std::optional<std::size_t>, TextFormat::kValues> columns;
    std::optional<TimeUnit> unit;
    SensorSize sensor;
    const char separator =
        format_.separator == '\0' && !is_comment ? shared_separator(content) : format_.separator;
    const auto fields = split(content, separator);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      int size = 0;
      const std::string name = plain_name(fields[i], size);
      const auto value = value_of_name(name);
      if (!value) {
        if (is_comment) return false;
        continue;
      }
      if (columns[*value]) return false;
      columns[*value] = i;
      if (*value == TextFormat::kTime) unit = unit_of_name(name);
      if (*value == TextFormat::kX) sensor.width = size;
      if (*value == TextFormat::kY) sensor.height = size;
    }
    const auto is_missing = [](const auto& column) { return !column; };
    const auto missing = std::count_if(columns.begin(), columns.end(), is_missing);
    if (missing > 0) {
      if (missing == TextFormat::kValues || is_comment) return false;
      refuse_line("expected the names of columns for time, x, y and polarity", content);
    }
    for (std::size_t i = 0; i < columns.size(); ++i) format_.columns[i] = *columns[i];
    format_.column_count = fields.size();
    format_.separator = separator;
    format_.description = content.substr(0, 60);
    has_names_ = true;
    if (unit && head_.options.text_unit == "auto") unit_ = unit;
    if (sensor.is_valid()) format_.sensor = sensor;
    return true;
  }

  void set_columns(std::string_view text) {
    std::string letters;
    for (const char character : text) {
      if (!is_in(character, kAnySeparator)) letters += character;
    }
    constexpr std::string_view kLetters = "txyp";
    bool is_complete = letters.size() == TextFormat::kValues;
    for (std::size_t i = 0; i < TextFormat::kValues; ++i) {
      const std::size_t column = letters.find(kLetters[i]);
      is_complete = is_complete && column != std::string::npos;
      format_.columns[i] = column;
    }
    if (!is_complete) {
      throw EventFileError("the columns must be t, x, y and p in some order, got \"" +
                           std::string(text) + "\"");
    }
    format_.description = text;
  }

  // The first line that should be an event; without names, it decides between the usual orders.
  void check_event(std::string_view content, bool is_whole) {
    TextEvent event;
    format_.has_quotes = content.find('"') != std::string_view::npos;
    // The smallest unit allows the largest numbers.
    TextFormat format = format_;
    format.unit = TimeUnit::kNanoseconds;
    if (parse_text_event(content, format, event)) return;
    const bool is_free =
        !has_names_ && head_.options.text_columns == EventFileOptions{}.text_columns;
    format.columns = {3, 0, 1, 2};
    if (is_free && parse_text_event(content, format, event)) {
      format_.columns = format.columns;
      format_.description = "x y p t";
      format_.notes.push_back("took the columns as `x y p t`, as the last one holds no polarity");
    } else if (is_whole) {
      refuse_line(
          "is neither a header of a known format nor text with one event a line: expected `" +
              format_.description + "`",
          content);
    }
  }

  TimeUnit guess_unit() {
    at_ = format_.header_bytes;
    TextTimes times;
    while (const auto line = next_line()) {
      // The last line may be cut.
      if (at_ == head_.bytes.size() && head_.text().back() != '\n' && !times.is_empty()) break;
      const std::string_view content = trimmed(*line);
      if (content.empty() || content.front() == '#' || content.front() == '%') continue;
      const auto fields = split(content, format_.separator);
      const std::size_t column = format_.columns[TextFormat::kTime];
      if (column < fields.size()) times.add(unquoted(fields[column]));
    }
    return times.unit(head_.name, format_.notes);
  }

  const StreamHead& head_;
  TextFormat format_;
  std::optional<TimeUnit> unit_;
  bool has_names_ = false;
  std::size_t at_ = 0;
  std::int64_t line_number_ = 0;
};

/// Goes through the fields of a line.
class LineCursor {
 public:
  LineCursor(std::string_view line, char separator)
      : at_(line.data()), end_(line.data() + line.size()), separator_(separator) {
    skip_blanks();
    while (at_ != end_ && (is_blank(end_[-1]) || end_[-1] == '\r')) --end_;
  }

  /// Moves from the end of a field to the next one.
  bool go_on() {
    if (separator_ == '\0') {
      const char* const before = at_;
      while (at_ != end_ && (is_blank(*at_) || *at_ == ',' || *at_ == ';')) ++at_;
      return at_ != before && at_ != end_;
    }
    skip_blanks();
    if (at_ == end_ || *at_ != separator_) return false;
    ++at_;
    skip_blanks();
    return true;
  }

  bool is_at_end() {
    skip_blanks();
    return at_ == end_;
  }

  void skip_field() {
    while (!is_at_boundary()) ++at_;
  }

  // Of any content.
  void skip_column() {
    if (separator_ == '\0') return skip_field();
    while (at_ != end_ && *at_ != separator_) ++at_;
  }

  bool read_time(int power_of_ten, std::int64_t& t_us) {
    const char* const start = at_;
    std::uint64_t whole = 0;
    const std::ptrdiff_t whole_digits = read_digits(whole);
    std::uint64_t fraction = 0;
    std::ptrdiff_t decimals = 0;
    if (at_ != end_ && *at_ == '.') {
      ++at_;
      decimals = read_digits(fraction);
    }
    if (whole_digits + decimals > 0 && whole_digits + decimals <= kMostDigits && is_at_boundary()) {
      const auto exponent = static_cast<std::ptrdiff_t>(power_of_ten);
      t_us = scaled(whole * kPowersOfTen[static_cast<std::size_t>(decimals)] + fraction,
                    exponent - decimals);
      return t_us <= static_cast<std::int64_t>(kLatestUs);
    }
    double value = 0;
    if (!read_double(start, value)) return false;
    const double time_us = value * std::pow(10.0, power_of_ten);
    if (!(time_us >= 0 && time_us <= kLatestUs)) return false;
    t_us = std::llround(time_us);
    return true;
  }

  /// A whole number, also if it is written with decimals.
  bool read_whole(int& value) {
    const char* const start = at_;
    std::uint64_t digits = 0;
    const std::ptrdiff_t count = read_digits(digits);
    if (count > 0 && count < 10 && is_at_boundary()) {
      value = static_cast<int>(digits);
      return true;
    }
    double number = 0;
    if (!read_double(start, number) || number != std::floor(number) ||
        std::abs(number) > std::numeric_limits<int>::max()) {
      return false;
    }
    value = static_cast<int>(number);
    return true;
  }

  bool read_polarity(bool& brighter) {
    const char* const start = at_;
    int value = 0;
    if (read_whole(value)) {
      brighter = value == 1;
      return value >= -1 && value <= 1;
    }
    at_ = start;
    skip_field();
    const std::string_view word(start, static_cast<std::size_t>(at_ - start));
    brighter = word == "True" || word == "true" || word == "ON" || word == "on";
    return brighter || word == "False" || word == "false" || word == "OFF" || word == "off";
  }

 private:
  // So many digits fit a number of 64 bits.
  static constexpr std::ptrdiff_t kMostDigits = 18;
  static constexpr std::array<std::uint64_t, kMostDigits + 1> kPowersOfTen = [] {
    std::array<std::uint64_t, kMostDigits + 1> powers{1};
    for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = 10 * powers[i - 1];
    return powers;
  }();

  static bool is_blank(char character) { return character == ' ' || character == '\t'; }

  bool is_at_boundary() const {
    return at_ == end_ || *at_ == separator_ || is_blank(*at_) ||
           (separator_ == '\0' && (*at_ == ',' || *at_ == ';'));
  }

  void skip_blanks() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
  }

  std::ptrdiff_t read_digits(std::uint64_t& value) {
    const char* const start = at_;
    for (; at_ != end_ && static_cast<unsigned>(*at_ - '0') < 10; ++at_) {
      value = 10 * value + static_cast<unsigned>(*at_ - '0');
    }
    return at_ - start;
  }

  bool read_double(const char* start, double& value) {
    if (start == end_) return false;
    const auto result = std::from_chars(start + (*start == '+' ? 1 : 0), end_, value);
    at_ = result.ptr;
    return result.ec == std::errc{} && std::isfinite(value) && is_at_boundary();
  }

  // value · 10^exponent, rounded.
  static std::int64_t scaled(std::uint64_t value, std::ptrdiff_t exponent) {
    if (exponent >= 0) {
      const std::uint64_t factor = kPowersOfTen[static_cast<std::size_t>(exponent)];
      if (value > static_cast<std::uint64_t>(kLatestUs) / factor) return kTooLate;
      return static_cast<std::int64_t>(value * factor);
    }
    if (-exponent > kMostDigits) return 0;
    const std::uint64_t divisor = kPowersOfTen[static_cast<std::size_t>(-exponent)];
    return static_cast<std::int64_t>((value + divisor / 2) / divisor);
  }

  static constexpr std::int64_t kTooLate = std::numeric_limits<std::int64_t>::max();

  const char* at_;
  const char* end_;
  char separator_;
};

}  // namespace

bool parse_text_event(std::string_view line, const TextFormat& format, TextEvent& event) {
  if (format.has_quotes && line.find('"') != std::string_view::npos) {
    std::string plain(line);
    std::erase(plain, '"');
    return parse_text_event(plain, format, event);
  }
  LineCursor cursor(line, format.separator);
  std::size_t found = 0;
  for (std::size_t column = 0; column < format.column_count; ++column) {
    if (column > 0 && !cursor.go_on()) return false;
    if (column == format.columns[TextFormat::kTime]) {
      if (!cursor.read_time(static_cast<int>(format.unit), event.t_us)) return false;
    } else if (column == format.columns[TextFormat::kX]) {
      if (!cursor.read_whole(event.x)) return false;
    } else if (column == format.columns[TextFormat::kY]) {
      if (!cursor.read_whole(event.y)) return false;
    } else if (column == format.columns[TextFormat::kPolarity]) {
      if (!cursor.read_polarity(event.brighter)) return false;
    } else {
      cursor.skip_column();
      continue;
    }
    ++found;
  }
  return found == TextFormat::kValues && cursor.is_at_end();
}

std::optional<TextFormat> find_text_format(const StreamHead& head) {
  return TextStart(head).format();
}

}  // namespace puck
