#include "common/io/evt3_decoder.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "common/events/event_bits.h"

namespace puck {
namespace {

enum WordType : std::uint32_t {
  kRow = 0x0,
  kColumn = 0x2,
  kVectorBase = 0x3,
  kVector12 = 0x4,
  kVector8 = 0x5,
  kTimeLow = 0x6,
  kContinued4 = 0x7,
  kTimeHigh = 0x8,
  kTrigger = 0xA,
  kImu = 0xD,
  kOther = 0xE,
  kContinued12 = 0xF,
};

// Rows, columns and vector bases: nearly all words.
constexpr std::uint32_t kQuietTypes = 1U << kRow | 1U << kColumn | 1U << kVectorBase;

constexpr std::ptrdiff_t kWordBytes = 2;
constexpr std::uint32_t kCoordinate = 0x07ff;
constexpr std::uint32_t kPayload = 0x0fff;
constexpr int kFlagBit = 11;

/// Four bits of a vector's mask: how many are set, and where, as steps from the first.
struct Steps {
  std::uint32_t count = 0;
  std::array<std::uint64_t, 4> bits{};  // The rest of them 0.
};

constexpr std::array<Steps, 16> make_steps() {
  std::array<Steps, 16> all{};
  for (std::uint32_t mask = 0; mask < 16; ++mask) {
    for (std::uint32_t x = 0; x < 4; ++x) {
      if ((mask >> x & 1U) != 0) all[mask].bits[all[mask].count++] = event_bits(x, 0, 0, 0);
    }
  }
  return all;
}
constexpr std::array<Steps, 16> kSteps = make_steps();

void store(std::uint64_t bits, Event* out) {
  std::memcpy(static_cast<void*>(out), &bits, sizeof bits);
}

/// Writes the events of a vector, of which `first` would be the first; returns the end of them.
/// Always writes four at a time, so that no branch depends on the mask: up to 12 places are
/// touched.
Event* put_vector(std::uint64_t first, std::uint32_t mask, Event* out) {
  for (std::uint32_t x = 0; x < 12; x += 4) {
    const Steps& steps = kSteps[mask >> x & 0xfU];
    const std::uint64_t first_of_four = first + event_bits(x, 0, 0, 0);
    for (std::size_t i = 0; i < 4; ++i) store(first_of_four + steps.bits[i], out + i);
    out += steps.count;
  }
  return out;
}

/// A vector base that is not known, or beyond all that a vector may begin at: every vector ends
/// beyond the last coordinate.
constexpr std::uint32_t kNoBase = 0x8000U | kCoordinate;

}  // namespace

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

void Evt3Decoder::finish() {
  EventPacket nothing;
  sink_.begin(nothing, 0);
  clock_.finish(sink_);
  sink_.counters().truncated_bytes += static_cast<std::int64_t>(words_.partial_bytes());
  words_.reset();
}

// Before an event of the newest time in the newest row. 0 where `take` has to look at it.
std::size_t Evt3Decoder::room_for_run() const {
  if (row_ < 0 || row_ >= sink_.sensor().height || !clock_.is_steady()) return 0;
  const std::size_t room = sink_.room_at(clock_.time_of(low_us_));
  // A vector that begins before the last place must not reach beyond the packet, nor fill it.
  return room > kMostInVector ? std::min(room - kMostInVector, kRunEvents) : 0;
}

// Takes words until one of them is not plain: it, or the events behind it, is left to `take`.
std::size_t Evt3Decoder::take_run(std::span<const std::byte> bytes) {
  Event* out = run_.data();
  const Event* const full = out + room_for_run();
  if (out == full) return 0;
  const auto width = static_cast<std::uint32_t>(sink_.sensor().width);
  const auto height = static_cast<std::uint32_t>(sink_.sensor().height);
  const auto time_now = [this] {
    const std::int64_t offset_us = clock_.time_of(low_us_) - sink_.packet_start();
    return event_bits(0, 0, 0, static_cast<std::uint32_t>(offset_us));
  };
  std::uint64_t time = time_now();
  // The newest payload of each type: rows, columns and bases follow one another without a pattern,
  // so that no branch may depend on which it is.
  std::array<std::uint32_t, 16> newest{};
  newest[kRow] = static_cast<std::uint32_t>(row_);
  newest[kVectorBase] = base_for_run();

  const std::byte* next = bytes.data();
  const std::byte* const end = next + static_cast<std::ptrdiff_t>(bytes.size() & ~std::size_t{1});
  for (; next != end && out < full; next += kWordBytes) {
    const std::uint32_t word = load_word<std::uint16_t>(next);
    const std::uint32_t type = word >> 12;
    if ((kQuietTypes >> type & 1U) != 0) {
      newest[type] = word & kPayload;
      const std::uint32_t row = newest[kRow] & kCoordinate;
      const std::uint32_t x = word & kCoordinate;
      // In the uppermost bits, which the compiler does not know how to branch on.
      const std::uint32_t is_event = (type ^ kColumn) - 1;
      const std::uint32_t is_inside = (x - width) & (row - height);
      if ((is_event & ~is_inside) >> 31 != 0) break;
      store(time + event_bits(x, row, word >> kFlagBit & 1U, 0), out);
      out += is_event >> 31;
    } else if (type == kVector12 || type == kVector8) {
      const std::uint32_t vector_width = type == kVector12 ? 12 : 8;
      const std::uint32_t row = newest[kRow] & kCoordinate;
      const std::uint32_t x = newest[kVectorBase] & kCoordinate;
      // The base is left within the bits of a coordinate.
      const std::uint32_t behind = x + vector_width;
      if (behind > width || behind > kCoordinate || row >= height) break;
      const std::uint32_t polarity = newest[kVectorBase] >> kFlagBit & 1U;
      out = put_vector(time + event_bits(x, row, polarity, 0), word & ((1U << vector_width) - 1),
                       out);
      newest[kVectorBase] += vector_width;
    } else if (type == kTimeLow) {
      const std::uint32_t old_low_us = std::exchange(low_us_, word & kPayload);
      const std::uint64_t old_time = std::exchange(time, time_now());
      // What an older time does to the events behind it is not for here.
      if (low_us_ < old_low_us || time < old_time) {
        next += kWordBytes;
        break;
      }
    } else {
      break;
    }
  }
  row_ = static_cast<int>(newest[kRow] & kCoordinate);
  if (newest[kVectorBase] != kNoBase) {
    vector_base_ = static_cast<int>(newest[kVectorBase] & kCoordinate);
    vector_brighter_ = (newest[kVectorBase] >> kFlagBit & 1U) != 0;
  }
  sink_.append_run({run_.data(), out});
  return static_cast<std::size_t>(next - bytes.data());
}

std::uint32_t Evt3Decoder::base_for_run() const {
  if (vector_base_ < 0 || vector_base_ > static_cast<int>(kCoordinate)) return kNoBase;
  return static_cast<std::uint32_t>(vector_base_) | (vector_brighter_ ? 1U << kFlagBit : 0U);
}

void Evt3Decoder::take(std::uint16_t word) {
  const std::uint32_t payload = word & kPayload;
  const int coordinate = static_cast<int>(word & kCoordinate);
  const bool flag = (word >> kFlagBit & 1U) != 0;
  switch (word >> 12) {
    case kRow:
      row_ = coordinate;
      return;
    case kColumn:
      take_event(coordinate, flag);
      return;
    case kVectorBase:
      vector_base_ = coordinate;
      vector_brighter_ = flag;
      return;
    case kVector12:
      take_vector(payload, 12);
      return;
    case kVector8:
      take_vector(payload & 0xffu, 8);
      return;
    case kTimeLow:
      low_us_ = payload;
      return;
    case kTimeHigh:
      // The low part starts again with each new high part.
      if (clock_.set_high(payload, sink_)) low_us_ = 0;
      return;
    case kTrigger:
    case kImu:
    case kOther:
    case kContinued4:
    case kContinued12:
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
  // A vector beyond every sensor need not be followed further.
  vector_base_ = std::min(vector_base_ + width, 2 * SensorSize::kMax);
}

}  // namespace puck
