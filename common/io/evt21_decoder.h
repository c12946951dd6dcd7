#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/events/event.h"
#include "common/io/event_decoder.h"
#include "common/io/event_sink.h"
#include "common/io/sensor_clock.h"
#include "common/io/word_assembler.h"

namespace puck {

/// Prophesee EVT 2.1: 64-bit words, each up to 32 events of one row, time and polarity; 34 bits of
/// time. Skips triggers and monitoring words. A word without an event, or whose first pixel is no
/// multiple of 32, counts as malformed.
class Evt21Decoder final : public EventDecoder {
 public:
  enum class Order : std::uint8_t {
    kLittle,  ///< The lower half first.
    kLegacy,  ///< The upper half first; each half is little-endian.
  };

  Evt21Decoder(SensorSize sensor, Order order, std::int64_t reorder_us = 0)
      : sink_(sensor, reorder_us), turn_bits_(order == Order::kLittle ? 0 : 32) {}

  std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet,
                     std::size_t max_events) override;
  void finish() override;
  bool has_backlog() const override { return sink_.has_backlog(); }
  const EventCounters& counters() const override { return sink_.counters(); }
  Timestamp newest() const override { return sink_.newest(); }

  /// The order in which more words of `data` are time words; nothing if neither is.
  static std::optional<Order> likely_order(std::span<const std::byte> data);

 private:
  static constexpr std::size_t kRunEvents = 1024;
  static constexpr std::size_t kVectorEvents = 32;

  std::size_t take_run(std::span<const std::byte> bytes);
  void take(std::uint64_t word);

  EventSink sink_;
  SensorClock clock_{28, 6};
  WordAssembler<std::uint64_t> words_;
  int turn_bits_ = 0;
  std::array<Event, kRunEvents + kVectorEvents> run_{};
};

}  // namespace puck
