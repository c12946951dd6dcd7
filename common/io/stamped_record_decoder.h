#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
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
  static constexpr std::size_t kAtOnce = 8;
  static constexpr std::uint32_t kUsualStepUs = 1'000'000;
  static constexpr std::int64_t kLongestRunUs = std::int64_t{kRunEvents} * kUsualStepUs;

  // Decodes records up to the first that needs the checks of `take`. The one that fills the packet
  // is also left to it.
  std::size_t take_run(std::span<const std::byte> bytes) {
    if (bytes.size() < kRecordBytes || !clock_.is_steady()) return 0;
    // So that no event of the run lies too long after the packet's start.
    const std::size_t room = std::min(sink_.room_at(clock_.time_of(0)),
                                      sink_.room_at(clock_.time_of(0) + kLongestRunUs));
    const std::size_t most =
        std::min({room - (room > 0 ? 1 : 0), kRunEvents, bytes.size() / kRecordBytes});
    const auto width = static_cast<std::uint32_t>(sink_.sensor().width);
    const auto height = static_cast<std::uint32_t>(sink_.sensor().height);
    const std::uint32_t first_stamp = clock_.raw();
    const auto base_us = static_cast<std::uint32_t>(clock_.time_of(0) - sink_.packet_start());
    std::uint32_t newest_stamp = first_stamp;

    // Whether a record is an ordinary one that follows a `newest` stamp. Writes its event.
    const auto put = [&](std::size_t i, std::uint32_t newest) {
      const auto record = load_word<std::uint64_t>(bytes.data() + i * kRecordBytes);
      const std::uint32_t stamp = layout_.stamp(record);
      const std::uint32_t x = layout_.x(record);
      const std::uint32_t y = layout_.y(record);
      run_[i] = std::bit_cast<Event>(
          event_bits(x, y, layout_.polarity(record), base_us + (stamp - first_stamp)));
      // A stamp that goes back is far ahead as an unsigned number.
      return static_cast<unsigned>(layout_.is_event(record)) & static_cast<unsigned>(x < width) &
             static_cast<unsigned>(y < height) &
             static_cast<unsigned>(stamp - newest <= kUsualStepUs) &
             static_cast<unsigned>(stamp >= newest);
    };
    const auto stamp_at = [&](std::size_t i) {
      return layout_.stamp(load_word<std::uint64_t>(bytes.data() + i * kRecordBytes));
    };
    // Several at once, without a branch.
    std::size_t taken = 0;
    for (; taken + kAtOnce <= most; taken += kAtOnce) {
      unsigned are_ordinary = put(taken, newest_stamp);
      for (std::size_t i = 1; i < kAtOnce; ++i) {
        are_ordinary &= put(taken + i, stamp_at(taken + i - 1));
      }
      if (are_ordinary == 0) break;
      newest_stamp = stamp_at(taken + kAtOnce - 1);
    }
    for (; taken < most && put(taken, newest_stamp) != 0; ++taken) newest_stamp = stamp_at(taken);
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
