#include "common/io/stamped_run.h"

#include <bit>

#include "common/events/event_bits.h"

// The rest of the file, up to the namespace's end, is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/io/stamped_run.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef PUCK_COMMON_IO_STAMPED_RUN_ONCE
#define PUCK_COMMON_IO_STAMPED_RUN_ONCE
namespace puck {

inline bool StampedRun::take() {
  const AddressRecord record(*layout, next);
  const std::uint32_t x = layout->x.of(record.address);
  const std::uint32_t y = layout->y.of(record.address);
  if (!layout->is_event(record.address) || x >= width || y >= height || !continues(record)) {
    return false;
  }
  stamp = record.stamp;
  *out++ =
      std::bit_cast<Event>(event_bits(x, y, layout->polarity.of(record.address), base_us + stamp));
  next += kRecordBytes;
  return true;
}

}  // namespace puck
#endif

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
using Records = hn::CappedTag<std::uint64_t, 8>;
using Bytes = hn::Repartition<std::uint8_t, Records>;
using RecordVector = hn::Vec<Records>;

HWY_INLINE RecordVector number(std::uint64_t value) { return hn::Set(Records(), value); }

/// A field in each lane, of which no more than the lower 32 bits count.
class LaneField {
 public:
  HWY_INLINE explicit LaneField(const StampedLayout::Field& field)
      : shift_(field.shift),
        mask_(field.mask),
        // -v is ~v + 1.
        turned_(field.is_mirrored ? ~std::uint64_t{0} : 0),
        added_(field.is_mirrored ? std::uint64_t{field.last} + 1 : 0) {}

  HWY_INLINE RecordVector of(RecordVector address) const {
    const auto value = hn::And(hn::ShiftRightSame(address, shift_), number(mask_));
    return hn::Add(hn::Xor(value, number(turned_)), number(added_));
  }

 private:
  int shift_;
  std::uint64_t mask_;
  std::uint64_t turned_;
  std::uint64_t added_;
};

template <bool kIsBigEndian>
HWY_INLINE RecordVector load_records(const std::byte* bytes) {
  const auto records = hn::LoadU(Records(), reinterpret_cast<const std::uint64_t*>(bytes));
  if constexpr (!kIsBigEndian) {
    return records;
  } else {
    alignas(16) static constexpr std::uint8_t kReversed[16] = {7,  6,  5,  4,  3,  2,  1, 0,
                                                               15, 14, 13, 12, 11, 10, 9, 8};
    return hn::BitCast(Records(), hn::TableLookupBytes(hn::BitCast(Bytes(), records),
                                                       hn::LoadDup128(Bytes(), kReversed)));
  }
}

/// The checks and the events of a vector of records.
template <bool kIsBigEndian>
class RecordVectors {
 public:
  HWY_INLINE explicit RecordVectors(const StampedRun& run)
      : x_(run.layout->x),
        y_(run.layout->y),
        polarity_(run.layout->polarity),
        stamp_mask_(run.layout->stamp_mask()),
        other_bits_(std::uint64_t{run.layout->other_bits} << 32),
        last_x_(run.width - 1),
        last_y_(run.height - 1),
        base_(std::uint64_t{run.base_us} << 32) {}

  /// Writes the events of the next records. Returns lanes that are negative where a record is not
  /// ordinary, or its stamp is not continued by that of the one after it.
  HWY_INLINE RecordVector put(const std::byte* next, Event* out) const {
    const auto record = load_records<kIsBigEndian>(next);
    const auto after = load_records<kIsBigEndian>(next + StampedRun::kRecordBytes);
    const auto address = hn::ShiftRight<32>(record);
    const auto x = x_.of(address);
    const auto y = y_.of(address);
    const auto stamp = hn::And(record, number(stamp_mask_));
    const auto place =
        hn::Or(hn::Or(x, hn::ShiftLeft<16>(y)), hn::ShiftLeft<31>(polarity_.of(address)));
    hn::StoreU(hn::Or(place, hn::Add(hn::ShiftLeft<32>(stamp), number(base_))), Records(),
               reinterpret_cast<std::uint64_t*>(out));
    const auto step = hn::Sub(hn::And(after, number(stamp_mask_)), stamp);
    const auto other = hn::And(record, number(other_bits_));
    return hn::Or(hn::Or(hn::Or(beyond(x, last_x_), beyond(y, last_y_)),
                         beyond(step, StampedRun::kLongestStepUs)),
                  hn::Or(other, hn::Sub(number(0), other)));
  }

 private:
  // Negative where `value`, a signed number, is not from 0 to `last`.
  static HWY_INLINE RecordVector beyond(RecordVector value, std::uint64_t last) {
    return hn::Or(value, hn::Sub(number(last), value));
  }

  LaneField x_;
  LaneField y_;
  LaneField polarity_;
  std::uint64_t stamp_mask_;
  std::uint64_t other_bits_;
  std::uint64_t last_x_;
  std::uint64_t last_y_;
  std::uint64_t base_;
};

// Decodes ordinary records, some vectors at a time.
template <bool kIsBigEndian>
HWY_INLINE void take_vectors(StampedRun& run) {
  constexpr std::ptrdiff_t kVectorsAtOnce = 2;
  const hn::RebindToSigned<Records> whole;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(Records()));
  const RecordVectors<kIsBigEndian> vectors(run);
  const std::byte* next = run.next;
  Event* out = run.out;
  // One record more, whose stamp is compared with the last one's.
  while (run.end - next > kVectorsAtOnce * lanes * StampedRun::kRecordBytes &&
         run.full - out >= kVectorsAtOnce * lanes) {
    const auto unusual = hn::Or(vectors.put(next, out),
                                vectors.put(next + lanes * StampedRun::kRecordBytes, out + lanes));
    if (!hn::AllFalse(whole, hn::Lt(hn::BitCast(whole, unusual), hn::Zero(whole)))) break;
    out += kVectorsAtOnce * lanes;
    next += kVectorsAtOnce * lanes * StampedRun::kRecordBytes;
  }
  if (next == run.next) return;
  run.stamp = AddressRecord(*run.layout, next - StampedRun::kRecordBytes).stamp;
  run.next = next;
  run.out = out;
}
#endif

void take_records(StampedRun& run) {
#if HWY_TARGET != HWY_SCALAR && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  // Vectors compare each record with the one after it only.
  if (run.next == run.end || !run.continues(AddressRecord(*run.layout, run.next))) return;
  if (run.layout->is_big_endian) {
    take_vectors<true>(run);
  } else {
    take_vectors<false>(run);
  }
#endif
  while (run.next != run.end && run.out < run.full && run.take()) {
  }
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {

HWY_EXPORT(take_records);

void take_stamped_records(StampedRun& run) { HWY_DYNAMIC_DISPATCH(take_records)(run); }

}  // namespace puck
#endif
