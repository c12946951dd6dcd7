#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace puck {

/// A packet of an IIT camera's events, from a line of a YARP text log.
struct YarpPacket {
  double host_time_s = 0;        ///< Sending time, s, on the sender's clock.
  std::int64_t duration_us = 0;  ///< Duration covered; 0 if the line does not state it.
  /// Whether the words were written as the bytes of a string, not as a list of numbers.
  bool is_bytes = false;
  /// 32 bits each: addresses, or pairs of a stamp and an address.
  std::vector<std::uint32_t> words;
  std::int64_t other_records = 0;     ///< Skipped: values in the line that are not events.
  std::int64_t cut_bytes = 0;         ///< Bytes left at the end of a cut line.
  std::int64_t malformed_values = 0;  ///< Skipped values.
};

/// Whether a file that begins with `head` is a YARP text log: `sequence time [time] TAG …`, with a
/// tag of capital letters.
bool is_yarp_log(std::string_view head);

/// Parses a line without its line end. `is_whole` is false for a line that the end of the file may
/// have cut: its last record is then left out unless it is complete. Reuses the memory of `packet`.
/// Returns false if the line does not have the form `sequence time [time] TAG …`.
bool parse_yarp_packet(std::string_view line, bool is_whole, YarpPacket& packet);

}  // namespace puck
