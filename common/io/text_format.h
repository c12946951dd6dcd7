#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/io/stream_start.h"

namespace puck {

/// Units of the times in text files; the number is the power of ten of the unit in µs.
enum class TimeUnit : std::int8_t {
  kSeconds = 6,
  kMilliseconds = 3,
  kMicroseconds = 0,
  kNanoseconds = -3,
};

/// How a text file with one event a line is laid out.
struct TextFormat {
  static constexpr std::size_t kValues = 4;
  enum Value : std::size_t { kTime, kX, kY, kPolarity };

  /// Of each value, the index of its column.
  std::array<std::size_t, kValues> columns{};
  std::size_t column_count = kValues;
  char separator = '\0';    ///< '\0': any run of blanks, tabs, `,` and `;`.
  bool has_quotes = false;  ///< Around numbers.
  TimeUnit unit = TimeUnit::kMicroseconds;
  std::string description;  ///< As "t x y p", in messages.

  std::optional<SensorSize> sensor;
  std::size_t header_bytes = 0;
  std::int64_t header_lines = 0;
  std::string repeat;  ///< As StreamStart::repeat.
  std::vector<std::string> notes;
};

/// An event as its line has it.
struct TextEvent {
  std::int64_t t_us = 0;
  int x = 0;
  int y = 0;
  bool brighter = false;
};

/// False when the line is no event in this format.
bool parse_text_event(std::string_view line, const TextFormat& format, TextEvent& event);

/// The columns' order, separator and unit from comments, a line of names, the first events and the
/// options. `std::nullopt` while more bytes are needed. Throws EventFileError, also where the unit
/// cannot be told.
std::optional<TextFormat> find_text_format(const StreamHead& head);

}  // namespace puck
