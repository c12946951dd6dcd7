#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/events/event.h"
#include "common/io/event_decoder.h"
#include "common/io/event_sink.h"
#include "common/io/sensor_clock.h"
#include "common/io/word_assembler.h"

namespace puck {

/// Prophesee EVT 2.0: 32-bit words, 34 bits of time. Skips triggers, monitoring and IMU words.
///
/// Runs of ordinary words are decoded in a tight loop; all others word by word. Both give the same
/// events and counts.
class Evt2Decoder final : public EventDecoder {
 public:
  explicit Evt2Decoder(SensorSize sensor) : sink_(sensor) {}

  std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet,
                     std::size_t max_events) override;
  void finish() override;
  bool has_backlog() const override { return sink_.has_backlog(); }
  const EventCounters& counters() const override { return sink_.counters(); }

 private:
  static constexpr std::size_t kRunEvents = 1024;

  std::size_t take_run(std::span<const std::byte> bytes);
  void take(std::uint32_t word);

  EventSink sink_;
  SensorClock clock_{28, 6};
  WordAssembler<std::uint32_t> words_;
  std::array<Event, kRunEvents> run_{};
};

}  // namespace puck
