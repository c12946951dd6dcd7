#include "common/io/text_event_reader.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/io/number_limits.h"
#include "common/io/parse_number.h"
#include "common/io/reader_warnings.h"
#include "common/io/trimmed.h"

namespace puck {
namespace {

constexpr std::string_view kAnySeparator = " \t,;";

bool is_in(char character, std::string_view set) {
  return set.find(character) != std::string_view::npos;
}

// The sink needs a size before the file has stated it.
constexpr SensorSize kAnySensor{SensorSize::kMax, SensorSize::kMax};

}  // namespace

TextEventReader::TextEventReader(const std::filesystem::path& path, const EventFileOptions& options)
    : name_(path.string()),
      options_(options),
      columns_(parse_columns(options.text_columns)),
      file_(path, std::ios::binary),
      sink_(kAnySensor) {
  const std::string& unit = options_.text_unit;
  if (unit != "auto" && unit != "s" && unit != "us") {
    throw EventFileError("the time's unit must be auto, s or us, got \"" + unit + "\"");
  }
  const std::string& separator = options_.text_separator;
  if (separator != "auto" && separator.size() != 1) {
    throw EventFileError("the separator must be auto or one character, got \"" + separator + "\"");
  }
  rewind();
}

bool TextEventReader::read(EventPacket& packet, std::size_t max_events) {
  packet.events.clear();
  sink_.begin(packet, max_events);
  while (sink_.has_room()) {
    if (!has_line_ && !next_event_line()) break;
    take_line();
    has_line_ = false;
  }
  return !packet.empty();
}

void TextEventReader::rewind() {
  file_.clear();
  file_.seekg(0);
  line_number_ = 0;
  has_line_ = false;
  read_preamble();
  try {
    sink_ = EventSink(sensor_);
  } catch (const std::invalid_argument& error) {
    throw EventFileError(name_ + ": " + error.what());
  }
}

std::vector<std::string> TextEventReader::warnings() const {
  return reader_warnings(name_, counters(), file_.eof() && !has_line_);
}

TextEventReader::Columns TextEventReader::parse_columns(std::string_view text) {
  std::string letters;
  for (const char character : text) {
    if (!is_in(character, kAnySeparator)) letters += character;
  }
  Columns columns;
  columns.time = letters.find('t');
  columns.x = letters.find('x');
  columns.y = letters.find('y');
  columns.polarity = letters.find('p');
  if (letters.size() != kColumnCount ||
      std::max({columns.time, columns.x, columns.y, columns.polarity}) >= kColumnCount) {
    throw EventFileError("the columns must be t, x, y and p in some order, got \"" +
                         std::string(text) + "\"");
  }
  return columns;
}

void TextEventReader::read_preamble() {
  said_sensor_ = {};
  has_line_ = next_event_line();
  if (has_line_ && take_column_names()) has_line_ = next_event_line();
  if (has_line_) choose_unit();

  const bool is_asked = options_.sensor != SensorSize{};
  const bool is_said = said_sensor_ != SensorSize{};
  if (!is_said && !is_asked) {
    throw EventFileError(name_ +
                         ": a text file does not say how large the sensor is; give width and "
                         "height (--width and --height, or the keys width and height)");
  }
  if (is_said && is_asked && said_sensor_ != options_.sensor) {
    throw EventFileError(name_ + ": %geometry and the options for width and height disagree");
  }
  sensor_ = is_said ? said_sensor_ : options_.sensor;
}

// Moves to the next line that should hold an event.
bool TextEventReader::next_event_line() {
  while (std::getline(file_, line_)) {
    ++line_number_;
    line_was_ended_ = !file_.eof();
    // A byte order mark.
    if (line_number_ == 1 && line_.starts_with("\xef\xbb\xbf")) line_.erase(0, 3);
    const std::string_view content = trimmed(line_);
    if (content.starts_with("%geometry:")) take_geometry();
    if (!content.empty() && content.front() != '#' && content.front() != '%') return true;
  }
  if (file_.bad()) throw EventFileError(name_ + ": cannot be read to its end");
  return false;
}

void TextEventReader::take_geometry() {
  std::string_view text = trimmed(line_);
  text.remove_prefix(text.find(':') + 1);
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos ||
      !parse_number(trimmed(text.substr(0, comma)), said_sensor_.width) ||
      !parse_number(trimmed(text.substr(comma + 1)), said_sensor_.height) ||
      !said_sensor_.is_valid()) {
    fail("%geometry:WIDTH,HEIGHT with both from 1 to 2048");
  }
}

bool TextEventReader::take_column_names() {
  std::array<std::string_view, kColumnCount> fields;
  if (!split(fields)) return false;
  for (const std::string_view field : fields) {
    if (field.size() != 1 || !is_in(field.front(), "txyp")) return false;
  }
  columns_ = parse_columns(trimmed(line_));
  return true;
}

void TextEventReader::choose_unit() {
  bool is_seconds = options_.text_unit == "s";
  if (options_.text_unit == "auto") {
    std::array<std::string_view, kColumnCount> fields;
    // take_line reports a malformed line.
    is_seconds = split(fields) && is_in('.', fields[columns_.time]);
  }
  us_per_unit_ = is_seconds ? 1e6 : 1;
}

// Returns false unless the line has as many fields as there are columns.
bool TextEventReader::split(std::array<std::string_view, kColumnCount>& fields) const {
  const bool any = options_.text_separator == "auto";
  const std::string_view separators =
      any ? kAnySeparator : std::string_view(options_.text_separator);
  std::string_view rest = trimmed(line_);
  for (std::size_t i = 0; i < kColumnCount; ++i) {
    const std::size_t end = std::min(rest.find_first_of(separators), rest.size());
    fields[i] = trimmed(rest.substr(0, end));
    if (fields[i].empty()) return false;
    if (i + 1 == kColumnCount) return end == rest.size();
    if (end == rest.size()) return false;
    rest.remove_prefix(end + 1);
    while (any && !rest.empty() && is_in(rest.front(), separators)) rest.remove_prefix(1);
  }
  return false;
}

void TextEventReader::take_line() {
  std::array<std::string_view, kColumnCount> fields;
  double time = 0;
  int x = 0;
  int y = 0;
  int polarity = 0;
  const bool is_event =
      split(fields) && parse_number(fields[columns_.time], time) &&
      parse_number(fields[columns_.x], x) && parse_number(fields[columns_.y], y) &&
      parse_number(fields[columns_.polarity], polarity) && polarity >= -1 && polarity <= 1;
  const double time_us = time * us_per_unit_;
  if (is_event && time_us >= 0 && time_us <= kLatestUs) {
    if (options_.text_unit == "auto" && us_per_unit_ == 1 && time != std::floor(time)) {
      fail("whole µs, because the first time has no decimal point (if the unit is s, say so)");
    }
    sink_.append({std::llround(time_us)}, x, y, polarity == 1);
  } else if (!line_was_ended_) {
    sink_.counters().truncated_bytes += static_cast<std::int64_t>(line_.size());
  } else {
    fail("`" + options_.text_columns + "` with a time of 0 or more in " +
         (us_per_unit_ == 1 ? "µs" : "s") + ", whole pixels, and a polarity of 1, 0 or -1");
  }
}

void TextEventReader::fail(const std::string& expected) const {
  constexpr std::size_t kLongestQuote = 60;
  throw EventFileError(name_ + ":" + std::to_string(line_number_) + ": expected " + expected +
                       ", got \"" + line_.substr(0, kLongestQuote) + "\"");
}

}  // namespace puck
