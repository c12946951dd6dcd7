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

  /// "EVT2", "EVT21", "EVT3" or whatever else the header names; empty when it names nothing.
  std::string encoding() const;
  /// What `format` or `geometry` say. Throws std::invalid_argument when either is malformed or they
  /// disagree.
  std::optional<SensorSize> sensor() const;
  /// What cameras with this `system_ID` have: for old headers without a geometry.
  std::optional<SensorSize> sensor_of_system() const;
};

/// Nothing while it takes more bytes to see where the header ends; never so when `is_all`. The
/// header ends with `% end` or before the first line that is none; it may be empty.
std::optional<RawHeader> parse_raw_header(std::span<const std::byte> bytes, bool is_all);

}  // namespace puck
