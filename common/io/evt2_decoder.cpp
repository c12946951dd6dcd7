#include "common/io/evt2_decoder.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "common/events/event_bits.h"

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
  return words_.feed(
      bytes, [this](std::span<const std::byte> rest) { return take_run(rest); },
      [this](std::uint32_t word) {
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

// Decodes events up to the first other word, or the first event that needs the checks of `take`.
// The event that fills the packet is also left to `take`.
std::size_t Evt2Decoder::take_run(std::span<const std::byte> bytes) {
  if (bytes.size() < sizeof(std::uint32_t) || !clock_.is_steady()) return 0;
  // Read from the first word of any type: the packet's free space does not depend on it.
  const auto low_us = [](std::uint32_t word) { return word >> 22 & 0x3fU; };
  const std::uint32_t first_us = low_us(load_word<std::uint32_t>(bytes.data()));
  const std::size_t room = sink_.room_at(clock_.time_of(first_us));
  const std::size_t most =
      std::min({room - (room > 0 ? 1 : 0), kRunEvents, bytes.size() / sizeof(std::uint32_t)});
  const auto width = static_cast<std::uint32_t>(sink_.sensor().width);
  const auto height = static_cast<std::uint32_t>(sink_.sensor().height);
  const std::int64_t base_us = clock_.time_of(0) - sink_.packet_start();
  std::int64_t newest_us = base_us + first_us;

  std::size_t taken = 0;
  for (; taken < most; ++taken) {
    const auto word = load_word<std::uint32_t>(bytes.data() + taken * sizeof(std::uint32_t));
    const std::uint32_t type = word >> 28;
    const std::uint32_t x = word >> 11 & 0x7ffU;
    const std::uint32_t y = word & 0x7ffU;
    const std::int64_t offset_us = base_us + low_us(word);
    if ((type > kBrighter) | (x >= width) | (y >= height) | (offset_us < newest_us) |
        (offset_us > std::numeric_limits<std::uint32_t>::max())) {
      break;
    }
    newest_us = offset_us;
    run_[taken] =
        std::bit_cast<Event>(event_bits(x, y, type, static_cast<std::uint32_t>(offset_us)));
  }
  sink_.append_run({run_.data(), taken});
  return taken * sizeof(std::uint32_t);
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
