#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/events/event.h"
#include "common/io/event_decoder.h"
#include "common/io/event_sink.h"
#include "common/io/sensor_clock.h"
#include "common/io/stamped_run.h"
#include "common/io/word_assembler.h"

namespace puck {

/// Records of eight bytes, each with a time stamp in µs and an address.
///
/// A stamp that continues the time, by up to a second, is accepted at once, and one up to a second
/// back belongs to a late event. SensorClock judges all others. Other records are skipped.
class StampedRecordDecoder final : public EventDecoder {
 public:
  StampedRecordDecoder(const StampedLayout& layout, SensorSize sensor, std::int64_t reorder_us)
      : layout_(layout),
        sink_(sensor, reorder_us),
        clock_(layout.stamp_bits, 0, StampedRun::kLongestStepUs) {}

  std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet,
                     std::size_t max_events) override;
  void finish() override;
  bool has_backlog() const override { return sink_.has_backlog(); }
  const EventCounters& counters() const override { return sink_.counters(); }
  Timestamp newest() const override { return sink_.newest(); }

 private:
  static constexpr std::size_t kRunEvents = 1024;

  std::size_t take_run(std::span<const std::byte> bytes);
  void take(std::uint64_t record);

  StampedLayout layout_;
  EventSink sink_;
  SensorClock clock_;
  WordAssembler<std::uint64_t> words_;
  // Aligned for the vectors that are written to it.
  alignas(64) std::array<Event, kRunEvents> run_{};
};

}  // namespace puck
