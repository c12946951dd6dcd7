#include "common/io/event_decoder.h"

#include "common/io/evt2_decoder.h"
#include "common/io/evt3_decoder.h"

namespace puck {

std::unique_ptr<EventDecoder> make_event_decoder(RawEncoding encoding, SensorSize sensor) {
  if (encoding == RawEncoding::kEvt2) return std::make_unique<Evt2Decoder>(sensor);
  return std::make_unique<Evt3Decoder>(sensor);
}

}  // namespace puck
