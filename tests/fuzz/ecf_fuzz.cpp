// Any bytes as one chunk of ECF; what it gives is packed and unpacked again.
#include <stdexcept>

#include "common/io/ecf_codec.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<puck::EcfEvent> events;
  try {
    puck::decode_ecf(std::as_bytes(std::span(data, size)), events);
  } catch (const std::invalid_argument& error) {
    puck::require(events.empty(), "a refused chunk gives nothing");
    puck::require_one_line(error.what());
    return 0;
  }
  puck::require(events.size() <= puck::kMostEcfEvents, "a chunk holds up to 65535 events");
  for (puck::EcfEvent& event : events) {
    puck::require(event.polarity == 0 || event.polarity == 1, "polarity is 0 or 1");
    // A mask may reach a little beyond the largest column.
    event.x &= 2047;
  }
  std::vector<std::byte> chunk;
  std::vector<puck::EcfEvent> again;
  puck::encode_ecf(events, chunk);
  puck::decode_ecf(chunk, again);
  puck::require(again == events, "what is packed is unpacked");
  return 0;
}
