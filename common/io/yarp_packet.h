#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace puck {

/// The tag of events.
inline constexpr std::string_view kYarpEventTag = "AE";
/// Tags are words of capital letters.
bool is_yarp_tag(std::string_view word);
/// Host times of a later year than 5138 are damaged, s.
inline constexpr double kLatestYarpTime_s = 1e11;

/// A packet of events of an IIT camera, as a line of a YARP text log or a message of a port holds
/// it.
struct YarpPacket {
  double host_time_s = 0;        ///< When it was sent, s, on the sender's clock.
  std::int64_t duration_us = 0;  ///< That it covers; 0 where the line does not say.
  /// Whether the words stood there as the bytes of a string, and not as a list of numbers.
  bool is_bytes = false;
  /// 32 bits each: addresses, or pairs of a stamp and an address.
  std::vector<std::uint32_t> words;
  std::int64_t other_records = 0;     ///< Passed over: values in the line that are no events.
  bool is_cut = false;                ///< The line ends before its list or string does.
  std::int64_t cut_bytes = 0;         ///< Left over at the end of such a list or string.
  std::int64_t malformed_values = 0;  ///< Passed over.
};

/// Whether a file that begins with `head` is a YARP text log: one of its lines is `sequence time
/// [time] TAG …`, with a tag of capital letters and a list or a string behind it.
bool is_yarp_log(std::string_view head);

/// Reads a line without its line end. Where it was cut, its last record is left out unless that is
/// complete. Reuses the memory of `packet`. False where the line is not of the form `sequence time
/// [time] TAG …`.
bool parse_yarp_packet(std::string_view line, YarpPacket& packet);

}  // namespace puck
