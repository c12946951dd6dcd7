#include "common/io/evt2_decoder.h"

namespace puck {
namespace {

enum WordType : std::uint32_t {
  kDarker = 0x0,
  kBrighter = 0x1,
  kTimeHigh = 0x8,
  kTrigger = 0xA,
  kImu = 0xD,
  kOther = 0xE,
  kContinued = 0xF,
};

}  // namespace

std::size_t Evt2Decoder::decode(std::span<const std::byte> bytes, EventPacket& packet,
                                std::size_t max_events) {
  sink_.begin(packet, max_events);
  if (!sink_.has_room()) return 0;
  return words_.feed(bytes, [this](std::uint32_t word) {
    take(word);
    return sink_.has_room();
  });
}

void Evt2Decoder::finish() {
  EventPacket nothing;
  sink_.begin(nothing, 0);
  clock_.finish(sink_);
  sink_.counters().truncated_bytes += static_cast<std::int64_t>(words_.partial_bytes());
  words_.reset();
}

void Evt2Decoder::take(std::uint32_t word) {
  const std::uint32_t type = word >> 28;
  switch (type) {
    case kDarker:
    case kBrighter:
      if (!clock_.is_known()) {
        ++sink_.counters().before_start;
        return;
      }
      clock_.append((word >> 22) & 0x3f, static_cast<int>((word >> 11) & 0x7ff),
                    static_cast<int>(word & 0x7ff), type == kBrighter, sink_);
      return;
    case kTimeHigh:
      clock_.set_high(word & 0x0fffffff, sink_);
      return;
    case kTrigger:
    case kImu:
    case kOther:
    case kContinued:
      return;
    default:
      ++sink_.counters().malformed_words;
  }
}

}  // namespace puck
