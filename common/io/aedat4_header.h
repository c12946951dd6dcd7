#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/io/aedat4_packing.h"

namespace puck {

inline constexpr std::string_view kAedat4Signature = "#!AER-DAT4.0\r\n";

/// A stream that the header of an AEDAT4 file describes.
struct Aedat4Stream {
  std::int32_t id = 0;
  std::string type;    ///< "EVTS", "FRME", "IMUS", "TRIG", …
  std::string source;  ///< Camera; empty if it is not told.
  SensorSize sensor;   ///< {0, 0}: not told.
};

/// What comes before the packets of an AEDAT4 file.
struct Aedat4Header {
  Aedat4Packing packing = Aedat4Packing::kNone;
  /// Byte of the file where the packets end and their index begins; −1: they last to its end.
  std::int64_t end_of_packets = -1;
  std::vector<Aedat4Stream> streams;
};

/// `buffer`: the FlatBuffer behind the signature, with its size before it. Throws
/// std::invalid_argument.
Aedat4Header parse_aedat4_header(std::span<const std::byte> buffer);

}  // namespace puck
