#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/events/sensor_size.h"

namespace puck {

/// The `% key value` lines at the start of a Prophesee RAW file or stream.
struct RawHeader {
  std::vector<std::pair<std::string, std::string>> fields;  ///< In the order of the lines.
  std::size_t length = 0;                                   ///< Bytes up to the first word.

  /// Empty when there is no such key.
  std::string_view value(std::string_view key) const;

  /// A warning for each line whose key an earlier one has; the first of them counts.
  std::vector<std::string> repeated_lines() const;

  /// The value of `key` in a line such as `% format EVT21;endianness=little`; empty without one.
  std::string_view format_option(std::string_view key) const;

  /// "EVT2", "EVT21", "EVT3", "EVT4" or another name in the header; empty if there is none.
  std::string encoding() const;
  /// Size from `format` or `geometry`. Throws std::invalid_argument when either is malformed or
  /// they disagree.
  std::optional<SensorSize> sensor() const;
  /// Size of the cameras with this `system_ID`, generation, or sensor's or driver's name: for old
  /// headers without a geometry.
  std::optional<SensorSize> sensor_of_camera() const;
};

/// `std::nullopt` while more bytes are needed to find the header's end; never with `is_all`. The
/// header ends with `% end` or before the first line that does not belong to it; it may be empty.
std::optional<RawHeader> parse_raw_header(std::span<const std::byte> bytes, bool is_all);

}  // namespace puck
