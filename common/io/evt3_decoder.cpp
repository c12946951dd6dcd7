#include "common/io/evt3_decoder.h"

#include <algorithm>
#include <bit>

namespace puck {
namespace {

enum WordType : std::uint32_t {
  kRow = 0x0,
  kColumn = 0x2,
  kVectorBase = 0x3,
  kVector12 = 0x4,
  kVector8 = 0x5,
  kTimeLow = 0x6,
  kContinued4 = 0x7,
  kTimeHigh = 0x8,
  kTrigger = 0xA,
  kImu = 0xD,
  kOther = 0xE,
  kContinued12 = 0xF,
};

}  // namespace

std::size_t Evt3Decoder::decode(std::span<const std::byte> bytes, EventPacket& packet,
                                std::size_t max_events) {
  sink_.begin(packet, max_events);
  if (!sink_.has_room()) return 0;
  return words_.feed(bytes, [this](std::uint16_t word) {
    take(word);
    return sink_.has_room();
  });
}

void Evt3Decoder::finish() {
  EventPacket nothing;
  sink_.begin(nothing, 0);
  clock_.finish(sink_);
  sink_.counters().truncated_bytes += static_cast<std::int64_t>(words_.partial_bytes());
  words_.reset();
}

void Evt3Decoder::take(std::uint16_t word) {
  const std::uint32_t payload = word & 0x0fffu;
  const int coordinate = static_cast<int>(word & 0x07ffu);
  const bool flag = (word & 0x0800u) != 0;
  switch (word >> 12) {
    case kRow:
      row_ = coordinate;
      return;
    case kColumn:
      take_event(coordinate, flag);
      return;
    case kVectorBase:
      vector_base_ = coordinate;
      vector_brighter_ = flag;
      return;
    case kVector12:
      take_vector(payload, 12);
      return;
    case kVector8:
      take_vector(payload & 0xffu, 8);
      return;
    case kTimeLow:
      low_us_ = payload;
      return;
    case kTimeHigh:
      // The low part starts again with each new high part.
      if (clock_.set_high(payload, sink_)) low_us_ = 0;
      return;
    case kTrigger:
    case kImu:
    case kOther:
    case kContinued4:
    case kContinued12:
      return;
    default:
      ++sink_.counters().malformed_words;
  }
}

void Evt3Decoder::take_event(int x, bool brighter) {
  if (row_ < 0 || !clock_.is_known()) {
    ++sink_.counters().before_start;
    return;
  }
  clock_.append(low_us_, x, row_, brighter, sink_);
}

void Evt3Decoder::take_vector(std::uint32_t mask, int width) {
  if (vector_base_ < 0) {
    sink_.counters().before_start += std::popcount(mask);
    return;
  }
  for (; mask != 0; mask &= mask - 1) {
    take_event(vector_base_ + std::countr_zero(mask), vector_brighter_);
  }
  // A vector beyond every sensor need not be followed further.
  vector_base_ = std::min(vector_base_ + width, 2 * SensorSize::kMax);
}

}  // namespace puck
