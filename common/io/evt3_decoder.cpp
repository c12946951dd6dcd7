#include "common/io/evt3_decoder.h"

#include <algorithm>
#include <bit>

#include "common/io/evt3_run.h"
#include "common/io/word_stream_end.h"

namespace puck {
std::size_t Evt3Decoder::decode(std::span<const std::byte> bytes, EventPacket& packet,
                                std::size_t max_events) {
  sink_.begin(packet, max_events);
  if (!sink_.has_room()) return 0;
  return words_.feed(
      bytes, [this](std::span<const std::byte> rest) { return take_run(rest); },
      [this](std::uint16_t word) {
        take(word);
        return sink_.has_room();
      });
}

void Evt3Decoder::finish() { finish_words(words_, clock_, sink_); }

// Number of events that a run may write at the newest time and row; 0 where they need `take`.
std::size_t Evt3Decoder::room_for_run() const {
  if (row_ < 0 || row_ >= sink_.sensor().height || !clock_.is_steady()) return 0;
  const std::size_t room = sink_.room_at(clock_.time_of(low_us_));
  // An event word may write up to kMostAtOnce places: the run must stay within the packet and not
  // fill it.
  return room > Evt3Run::kMostAtOnce ? std::min(room - Evt3Run::kMostAtOnce, kRunEvents) : 0;
}

// Decodes words up to the first that needs the checks of `take`, itself or for the events after it.
std::size_t Evt3Decoder::take_run(std::span<const std::byte> bytes) {
  Evt3Run run;
  run.next = bytes.data();
  run.end = run.next + static_cast<std::ptrdiff_t>(bytes.size() & ~std::size_t{1});
  run.out = run_.data();
  run.full = run.out + room_for_run();
  if (run.out == run.full) return 0;
  run.width = static_cast<std::uint32_t>(sink_.sensor().width);
  run.height = static_cast<std::uint32_t>(sink_.sensor().height);
  run.offset_us = clock_.time_of(0) - sink_.packet_start();
  run.low_us = low_us_;
  run.row = static_cast<std::uint32_t>(row_);
  run.base = base_for_run();
  take_evt3_words(run);

  low_us_ = run.low_us;
  row_ = static_cast<int>(run.row & Evt3Run::kCoordinate);
  if (run.base != Evt3Run::kNoBase) {
    vector_base_ = static_cast<int>(run.base & Evt3Run::kCoordinate);
    vector_brighter_ = (run.base >> Evt3Run::kFlagBit & 1U) != 0;
  }
  sink_.append_run({run_.data(), run.out});
  return static_cast<std::size_t>(run.next - bytes.data());
}

std::uint32_t Evt3Decoder::base_for_run() const {
  if (vector_base_ < 0 || vector_base_ > static_cast<int>(Evt3Run::kCoordinate))
    return Evt3Run::kNoBase;
  return static_cast<std::uint32_t>(vector_base_) |
         (vector_brighter_ ? 1U << Evt3Run::kFlagBit : 0U);
}

void Evt3Decoder::take(std::uint16_t word) {
  const std::uint32_t payload = word & Evt3Run::kPayload;
  const int coordinate = static_cast<int>(word & Evt3Run::kCoordinate);
  const bool flag = (word >> Evt3Run::kFlagBit & 1U) != 0;
  switch (static_cast<Evt3Type>(word >> 12)) {
    case Evt3Type::kRow:
      row_ = coordinate;
      return;
    case Evt3Type::kColumn:
      take_event(coordinate, flag);
      return;
    case Evt3Type::kVectorBase:
      vector_base_ = coordinate;
      vector_brighter_ = flag;
      return;
    case Evt3Type::kVector12:
      take_vector(payload, 12);
      return;
    case Evt3Type::kVector8:
      take_vector(payload & 0xffu, 8);
      return;
    case Evt3Type::kTimeLow:
      low_us_ = payload;
      return;
    case Evt3Type::kTimeHigh:
      // The low part restarts with each new high part.
      if (clock_.set_high(payload, sink_)) low_us_ = 0;
      return;
    case Evt3Type::kTrigger:
    case Evt3Type::kImu:
    case Evt3Type::kOther:
    case Evt3Type::kContinued4:
    case Evt3Type::kContinued12:
      return;
    default:
      ++sink_.counters().malformed_words;
  }
}

void Evt3Decoder::take_event(int x, bool brighter) {
  if (row_ < 0 || !clock_.is_known()) {
    ++sink_.counters().before_start;
    return;
  }
  clock_.append(low_us_, x, row_, brighter, sink_);
}

void Evt3Decoder::take_vector(std::uint32_t mask, int width) {
  if (vector_base_ < 0) {
    sink_.counters().before_start += std::popcount(mask);
    return;
  }
  for (; mask != 0; mask &= mask - 1) {
    take_event(vector_base_ + std::countr_zero(mask), vector_brighter_);
  }
  // A vector beyond the largest sensor needs no exact base.
  vector_base_ = std::min(vector_base_ + width, 2 * SensorSize::kMax);
}

}  // namespace puck
