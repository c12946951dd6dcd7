#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/events/event.h"
#include "common/io/cd_word_run.h"
#include "common/io/event_decoder.h"
#include "common/io/event_sink.h"
#include "common/io/sensor_clock.h"
#include "common/io/word_assembler.h"

namespace puck {

/// What EVT 2.0 and EVT 4.0 share: 32-bit words whose upper four bits are their type; an event has
/// the lower six bits of its time, x and y, a time word the upper 28 bits of the time.
///
/// Runs of events and of the time words between them are decoded in a tight loop; all other words
/// one by one. Both give the same events and counts.
class CdWordDecoder : public EventDecoder {
 public:
  std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet,
                     std::size_t max_events) override;
  void finish() override;
  bool has_backlog() const override { return sink_.has_backlog(); }
  const EventCounters& counters() const override { return sink_.counters(); }
  Timestamp newest() const override { return sink_.newest(); }

 protected:
  /// `darker`: the type of an event; that of an event of the other polarity follows it.
  /// `time_type`: that of a time word.
  CdWordDecoder(SensorSize sensor, std::int64_t reorder_us, std::uint32_t darker,
                std::uint32_t time_type)
      : sink_(sensor, reorder_us), darker_(darker), time_type_(time_type) {}

  virtual void take(std::uint32_t word) = 0;
  /// Whether the next word is data, whatever its upper bits.
  virtual bool is_data_next() const { return false; }

  void take_event(std::uint32_t word, bool brighter);
  void take_time(std::uint32_t word) { clock_.set_high(word & CdWordRun::kHigh, sink_); }

  EventSink sink_;
  SensorClock clock_{28, 6};

 private:
  static constexpr std::size_t kRunEvents = 1024;

  std::size_t take_run(std::span<const std::byte> bytes);

  std::uint32_t darker_ = 0;
  std::uint32_t time_type_ = 0;
  WordAssembler<std::uint32_t> words_;
  // Aligned for the vectors that are written to it.
  alignas(64) std::array<Event, kRunEvents> run_{};
};

}  // namespace puck
