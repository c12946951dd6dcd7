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

/// What EVT 2.0 and EVT 4.0 share: 32-bit words whose upper four bits are their type; an event has
/// the lower six bits of its time, x and y, a time word the upper 28 bits of the time.
///
/// Runs of events are decoded in a tight loop; all other words one by one. Both give the same
/// events and counts.
class CdWordDecoder : public EventDecoder {
 public:
  std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet,
                     std::size_t max_events) override;
  void finish() override;
  bool has_backlog() const override { return sink_.has_backlog(); }
  const EventCounters& counters() const override { return sink_.counters(); }

 protected:
  /// `darker`: the type of an event; that of an event of the other polarity follows it.
  CdWordDecoder(SensorSize sensor, std::int64_t reorder_us, std::uint32_t darker)
      : sink_(sensor, reorder_us), darker_(darker) {}

  static std::uint32_t low_us(std::uint32_t word) { return word >> 22 & 0x3fU; }
  static std::uint32_t x_of(std::uint32_t word) { return word >> 11 & 0x7ffU; }
  static std::uint32_t y_of(std::uint32_t word) { return word & 0x7ffU; }

  virtual void take(std::uint32_t word) = 0;
  /// Whether the next word is data, whatever its upper bits.
  virtual bool is_data_next() const { return false; }

  void take_event(std::uint32_t word, bool brighter);
  void take_time(std::uint32_t word) { clock_.set_high(word & 0x0fffffff, sink_); }

  EventSink sink_;
  SensorClock clock_{28, 6};

 private:
  static constexpr std::size_t kRunEvents = 1024;

  std::size_t take_run(std::span<const std::byte> bytes);

  std::uint32_t darker_ = 0;
  WordAssembler<std::uint32_t> words_;
  std::array<Event, kRunEvents> run_{};
};

}  // namespace puck
