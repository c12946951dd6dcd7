#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/events/event.h"
#include "common/io/event_decoder.h"
#include "common/io/event_sink.h"
#include "common/io/evt3_run.h"
#include "common/io/sensor_clock.h"
#include "common/io/word_assembler.h"

namespace puck {

/// Prophesee EVT 3.0: 16-bit words that depend on earlier ones, 24 bits of time, up to 12 events a
/// word. Skips triggers, monitoring and IMU words.
///
/// Runs of ordinary words are decoded in a tight loop; all others word by word. Both give the same
/// events and counts.
class Evt3Decoder final : public EventDecoder {
 public:
  explicit Evt3Decoder(SensorSize sensor, std::int64_t reorder_us = 0)
      : sink_(sensor, reorder_us) {}

  std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet,
                     std::size_t max_events) override;
  void finish() override;
  bool has_backlog() const override { return sink_.has_backlog(); }
  const EventCounters& counters() const override { return sink_.counters(); }
  Timestamp newest() const override { return sink_.newest(); }

 private:
  static constexpr std::size_t kRunEvents = 1024;

  std::size_t take_run(std::span<const std::byte> bytes);
  std::size_t room_for_run() const;
  std::uint32_t base_for_run() const;
  void take(std::uint16_t word);
  void take_event(int x, bool brighter);
  void take_vector(std::uint32_t mask, int width);

  EventSink sink_;
  SensorClock clock_{12, 12};
  WordAssembler<std::uint16_t> words_;

  std::uint32_t low_us_ = 0;
  int row_ = -1;          // −1: unknown.
  int vector_base_ = -1;  // −1: unknown.
  bool vector_brighter_ = false;

  std::array<Event, kRunEvents + Evt3Run::kMostAtOnce> run_{};
};

}  // namespace puck
