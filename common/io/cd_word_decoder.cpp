#include "common/io/cd_word_decoder.h"

#include <algorithm>

#include "common/io/word_stream_end.h"

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

void CdWordDecoder::finish() { finish_words(words_, clock_, sink_); }

// Decodes events and time words up to the first that needs the checks of `take`. The event that
// fills the packet is also left to it.
std::size_t CdWordDecoder::take_run(std::span<const std::byte> bytes) {
  if (!clock_.is_steady() || is_data_next()) return 0;
  const Timestamp base = clock_.time_of(0);
  const std::int64_t low_us = sink_.newest() > base ? sink_.newest() - base : 0;
  if (low_us > CdWordRun::kLowUs) return 0;
  const std::size_t room = sink_.room_at(base + low_us);
  if (room < 2) return 0;
  CdWordRun run;
  run.next = bytes.data();
  run.end = run.next + static_cast<std::ptrdiff_t>(bytes.size() & ~std::size_t{3});
  run.out = run_.data();
  run.full = run.out + std::min(room - 1, kRunEvents);
  run.width = static_cast<std::uint32_t>(sink_.sensor().width);
  run.height = static_cast<std::uint32_t>(sink_.sensor().height);
  run.darker = darker_;
  run.time_type = time_type_;
  run.high = clock_.raw();
  run.offset_us = base - sink_.packet_start();
  run.low_us = static_cast<std::uint32_t>(low_us);
  take_cd_words(run);
  clock_.advance(run.steps);
  sink_.append_run({run_.data(), run.out});
  return static_cast<std::size_t>(run.next - bytes.data());
}

void CdWordDecoder::take_event(std::uint32_t word, bool brighter) {
  if (!clock_.is_known()) {
    ++sink_.counters().before_start;
    return;
  }
  clock_.append(CdWordRun::low_us_of(word), static_cast<int>(CdWordRun::x_of(word)),
                static_cast<int>(CdWordRun::y_of(word)), brighter, sink_);
}

}  // namespace puck
