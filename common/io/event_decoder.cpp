#include "common/io/event_decoder.h"

#include "common/io/evt21_decoder.h"
#include "common/io/evt2_decoder.h"
#include "common/io/evt3_decoder.h"
#include "common/io/evt4_decoder.h"

namespace puck {

EventCounters& EventCounters::operator+=(const EventCounters& other) {
  events += other.events;
  before_start += other.before_start;
  outside_sensor += other.outside_sensor;
  backwards += other.backwards;
  reordered += other.reordered;
  missing += other.missing;
  other_data += other.other_data;
  malformed_words += other.malformed_words;
  time_glitches += other.time_glitches;
  time_wraps += other.time_wraps;
  truncated_bytes += other.truncated_bytes;
  return *this;
}

std::unique_ptr<EventDecoder> make_event_decoder(RawEncoding encoding, SensorSize sensor,
                                                 std::int64_t reorder_us) {
  using Order = Evt21Decoder::Order;
  switch (encoding) {
    case RawEncoding::kEvt2:
      return std::make_unique<Evt2Decoder>(sensor, reorder_us);
    case RawEncoding::kEvt21:
      return std::make_unique<Evt21Decoder>(sensor, Order::kLittle, reorder_us);
    case RawEncoding::kEvt21Legacy:
      return std::make_unique<Evt21Decoder>(sensor, Order::kLegacy, reorder_us);
    case RawEncoding::kEvt4:
      return std::make_unique<Evt4Decoder>(sensor, reorder_us);
    case RawEncoding::kEvt3:
      break;
  }
  return std::make_unique<Evt3Decoder>(sensor, reorder_us);
}

}  // namespace puck
