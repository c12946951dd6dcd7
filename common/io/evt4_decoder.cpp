#include "common/io/evt4_decoder.h"

#include <bit>

namespace puck {

void Evt4Decoder::take(std::uint32_t word) {
  if (vector_) {
    const std::uint32_t vector = *vector_;
    vector_.reset();
    take_vector(vector, word);
    return;
  }
  switch (word >> 28) {
    case kDarker:
    case kDarker + 1:
      take_event(word, word >> 28 != kDarker);
      return;
    case kDarkerVector:
    case kDarkerVector + 1:
      vector_ = word;
      return;
    case kTime:
      take_time(word);
      return;
    case 0x6:  // Monitoring.
    case 0x7:  // Continued.
    case 0x9:  // Trigger.
      return;
    case 0xF:
      if (word == 0xffffffff) return;  // Padding.
      [[fallthrough]];
    default:
      ++sink_.counters().malformed_words;
  }
}

void Evt4Decoder::take_vector(std::uint32_t vector, std::uint32_t mask) {
  if (!clock_.is_known()) {
    sink_.counters().before_start += std::popcount(mask);
    return;
  }
  const bool brighter = vector >> 28 != kDarkerVector;
  const int y = static_cast<int>(CdWordRun::y_of(vector));
  for (; mask != 0; mask &= mask - 1) {
    const int x = static_cast<int>(CdWordRun::x_of(vector)) + std::countr_zero(mask);
    clock_.append(CdWordRun::low_us_of(vector), x, y, brighter, sink_);
  }
}

}  // namespace puck
