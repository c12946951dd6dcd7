#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "common/events/event.h"
#include "common/events/event_bits.h"
#include "common/io/event_decoder.h"
#include "common/io/event_sink.h"
#include "common/io/sensor_clock.h"
#include "common/io/word_assembler.h"

namespace puck {

/// Records of eight bytes, each with a time stamp in µs and an address. `Layout` has
///
/// - `kStampBits`: after so many bits, stamps wrap;
/// - `stamp(record)`, `is_event(record)`, `x(record)`, `y(record)`, `polarity(record)`, where
/// `record`
///   is the little-endian number of its bytes.
///
/// A stamp that continues the time, by up to a second, is accepted at once, and one up to a second
/// back belongs to a late event. SensorClock judges all others. Other records are skipped.
template <typename Layout>
class StampedRecordDecoder final : public EventDecoder {
 public:
  StampedRecordDecoder(Layout layout, SensorSize sensor, std::int64_t reorder_us)
      : layout_(layout), sink_(sensor, reorder_us) {}

  std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet,
                     std::size_t max_events) override {
    sink_.begin(packet, max_events);
    if (!sink_.has_room()) return 0;
    return words_.feed(
        bytes, [this](std::span<const std::byte> rest) { return take_run(rest); },
        [this](std::uint64_t record) {
          take(record);
          return sink_.has_room();
        });
  }

  void finish() override {
    EventPacket nothing;
    sink_.begin(nothing, 0);
    clock_.finish(sink_);
    sink_.counters().truncated_bytes += static_cast<std::int64_t>(words_.partial_bytes());
    words_.reset();
  }

  bool has_backlog() const override { return sink_.has_backlog(); }
  const EventCounters& counters() const override { return sink_.counters(); }

 private:
  static constexpr std::size_t kRecordBytes = sizeof(std::uint64_t);
  static constexpr std::size_t kRunEvents = 1024;
  static constexpr std::int64_t kUsualStepUs = 1'000'000;

  // Decodes records up to the first that needs the checks of `take`. The one that fills the packet
  // is also left to it.
  std::size_t take_run(std::span<const std::byte> bytes) {
    if (bytes.size() < kRecordBytes || !clock_.is_steady()) return 0;
    const std::size_t room = sink_.room_at(clock_.time_of(0));
    const std::size_t most =
        std::min({room - (room > 0 ? 1 : 0), kRunEvents, bytes.size() / kRecordBytes});
    const auto width = static_cast<std::uint32_t>(sink_.sensor().width);
    const auto height = static_cast<std::uint32_t>(sink_.sensor().height);
    const std::uint32_t first_stamp = clock_.raw();
    const std::int64_t base_us = clock_.time_of(0) - sink_.packet_start();
    std::uint32_t newest_stamp = first_stamp;

    std::size_t taken = 0;
    for (; taken < most; ++taken) {
      const auto record = load_word<std::uint64_t>(bytes.data() + taken * kRecordBytes);
      const std::uint32_t stamp = layout_.stamp(record);
      const std::uint32_t x = layout_.x(record);
      const std::uint32_t y = layout_.y(record);
      const std::int64_t offset_us = base_us + (stamp - first_stamp);
      if (!layout_.is_event(record) || x >= width || y >= height || stamp < newest_stamp ||
          stamp - newest_stamp > kUsualStepUs ||
          offset_us > std::numeric_limits<std::uint32_t>::max()) {
        break;
      }
      newest_stamp = stamp;
      run_[taken] = std::bit_cast<Event>(
          event_bits(x, y, layout_.polarity(record), static_cast<std::uint32_t>(offset_us)));
    }
    sink_.append_run({run_.data(), taken});
    clock_.advance(newest_stamp - first_stamp);
    return taken * kRecordBytes;
  }

  void take(std::uint64_t record) {
    if (!layout_.is_event(record)) {
      ++sink_.counters().other_data;
      return;
    }
    const std::uint32_t stamp = layout_.stamp(record);
    const auto x = static_cast<int>(layout_.x(record));
    const auto y = static_cast<int>(layout_.y(record));
    const bool brighter = layout_.polarity(record) != 0;
    if (clock_.is_steady()) {
      if (const auto behind_us = clock_.steps_behind(stamp, kUsualStepUs)) {
        sink_.append(clock_.time_of(0) - *behind_us, x, y, brighter);
        return;
      }
    }
    clock_.set_high(stamp, sink_);
    clock_.append(0, x, y, brighter, sink_);
  }

  Layout layout_;
  EventSink sink_;
  SensorClock clock_{Layout::kStampBits, 0, kUsualStepUs};
  WordAssembler<std::uint64_t> words_;
  std::array<Event, kRunEvents> run_{};
};

}  // namespace puck
