#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/text_format.h"

namespace puck {

/// What the times at the beginning of a text file look like.
class TextTimes {
 public:
  /// Takes the text of the next event's time.
  void add(std::string_view time);
  bool is_empty() const { return count_ == 0; }

  /// The only unit that is possible; else the usual one, s with a decimal point and µs without one,
  /// if it is possible. A unit is possible when the rate of events and the form of the numbers are
  /// those of a camera. Throws EventFileError, with the reasons, if several others are.
  TimeUnit unit(const std::string& name, std::vector<std::string>& notes) const;

 private:
  bool is_possible(TimeUnit unit) const;
  double events_a_second(TimeUnit unit) const;
  double span_s(TimeUnit unit) const;
  std::string describe(TimeUnit unit) const;

  std::int64_t count_ = 0;
  double oldest_ = 0;
  double newest_ = 0;
  bool has_point_ = false;
  bool has_fraction_ = false;
  bool is_in_thousands_ = true;
  int most_decimals_ = 0;
};

/// The unit that a column's name states, as `t_us`, `time[s]` or `timestamp_ns`.
std::optional<TimeUnit> unit_of_name(std::string_view name);

/// The unit of this name: "s", "ms", "us" or "ns".
std::optional<TimeUnit> unit_called(std::string_view name);

}  // namespace puck
