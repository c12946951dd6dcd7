#include "common/io/evt2_decoder.h"

namespace puck {

void Evt2Decoder::take(std::uint32_t word) {
  switch (word >> 28) {
    case kDarker:
    case kDarker + 1:
      take_event(word, word >> 28 != kDarker);
      return;
    case kTime:
      take_time(word);
      return;
    case 0xA:  // Trigger.
    case 0xD:  // IMU.
    case 0xE:  // Monitoring.
    case 0xF:  // Continued.
      return;
    default:
      ++sink_.counters().malformed_words;
  }
}

}  // namespace puck
