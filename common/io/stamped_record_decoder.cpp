#include "common/io/stamped_record_decoder.h"

#include <algorithm>

#include "common/io/word_stream_end.h"

namespace puck {

std::size_t StampedRecordDecoder::decode(std::span<const std::byte> bytes, EventPacket& packet,
                                         std::size_t max_events) {
  sink_.begin(packet, max_events);
  if (!sink_.has_room()) return 0;
  return words_.feed(
      bytes, [this](std::span<const std::byte> rest) { return take_run(rest); },
      [this](std::uint64_t record) {
        take(record);
        return sink_.has_room();
      });
}

void StampedRecordDecoder::finish() { finish_words(words_, clock_, sink_); }

// Decodes records up to the first that needs the checks of `take`. The one that fills the packet is
// also left to it.
std::size_t StampedRecordDecoder::take_run(std::span<const std::byte> bytes) {
  if (!clock_.is_steady()) return 0;
  // So that no event of the run lies too long after the packet's start.
  constexpr std::int64_t kLongestRunUs = std::int64_t{kRunEvents} * StampedRun::kLongestStepUs;
  const Timestamp now = clock_.time_of(0);
  const std::size_t room = std::min(sink_.room_at(now), sink_.room_at(now + kLongestRunUs));
  if (room < 2) return 0;
  StampedRun run;
  run.layout = &layout_;
  run.next = bytes.data();
  run.end = run.next + static_cast<std::ptrdiff_t>(bytes.size() & ~std::size_t{7});
  run.out = run_.data();
  run.full = run.out + std::min(room - 1, kRunEvents);
  run.width = static_cast<std::uint32_t>(sink_.sensor().width);
  run.height = static_cast<std::uint32_t>(sink_.sensor().height);
  run.stamp = clock_.raw();
  run.base_us = static_cast<std::uint32_t>(now - sink_.packet_start()) - run.stamp;
  take_stamped_records(run);
  clock_.advance(run.stamp - clock_.raw());
  sink_.append_run({run_.data(), run.out});
  return static_cast<std::size_t>(run.next - bytes.data());
}

void StampedRecordDecoder::take(std::uint64_t bytes) {
  const AddressRecord record(layout_, bytes);
  if (!layout_.is_event(record.address)) {
    ++sink_.counters().other_data;
    return;
  }
  const auto x = static_cast<int>(layout_.x.of(record.address));
  const auto y = static_cast<int>(layout_.y.of(record.address));
  const bool brighter = layout_.polarity.of(record.address) != 0;
  if (clock_.is_steady()) {
    if (const auto behind_us = clock_.steps_behind(record.stamp, StampedRun::kLongestStepUs)) {
      sink_.append(clock_.time_of(0) - *behind_us, x, y, brighter);
      return;
    }
  }
  clock_.set_high(record.stamp, sink_);
  clock_.append(0, x, y, brighter, sink_);
}

}  // namespace puck
