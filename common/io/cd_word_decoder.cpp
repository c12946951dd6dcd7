#include "common/io/cd_word_decoder.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "common/events/event_bits.h"

namespace puck {

std::size_t CdWordDecoder::decode(std::span<const std::byte> bytes, EventPacket& packet,
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

void CdWordDecoder::finish() {
  EventPacket nothing;
  sink_.begin(nothing, 0);
  clock_.finish(sink_);
  sink_.counters().truncated_bytes += static_cast<std::int64_t>(words_.partial_bytes());
  words_.reset();
}

// Decodes events up to the first other word, or the first event that needs the checks of `take`.
// The event that fills the packet is also left to `take`.
std::size_t CdWordDecoder::take_run(std::span<const std::byte> bytes) {
  if (bytes.size() < sizeof(std::uint32_t) || !clock_.is_steady() || is_data_next()) return 0;
  // Read from the first word of any type: the packet's free space does not depend on it.
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
    const std::uint32_t polarity = (word >> 28) - darker_;
    const std::uint32_t x = x_of(word);
    const std::uint32_t y = y_of(word);
    const std::int64_t offset_us = base_us + low_us(word);
    if ((polarity > 1) | (x >= width) | (y >= height) | (offset_us < newest_us) |
        (offset_us > std::numeric_limits<std::uint32_t>::max())) {
      break;
    }
    newest_us = offset_us;
    run_[taken] =
        std::bit_cast<Event>(event_bits(x, y, polarity, static_cast<std::uint32_t>(offset_us)));
  }
  sink_.append_run({run_.data(), taken});
  return taken * sizeof(std::uint32_t);
}

void CdWordDecoder::take_event(std::uint32_t word, bool brighter) {
  if (!clock_.is_known()) {
    ++sink_.counters().before_start;
    return;
  }
  clock_.append(low_us(word), static_cast<int>(x_of(word)), static_cast<int>(y_of(word)), brighter,
                sink_);
}

}  // namespace puck
