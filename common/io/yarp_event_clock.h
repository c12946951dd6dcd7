#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "common/events/timestamp.h"

namespace puck {

/// A record of a YARP log whose stamp counts ticks.
struct StampedRecord {
  std::uint32_t stamp = 0;    ///< 31 bits; wraps.
  double host_time_s = 0;     ///< When its packet was sent.
  std::uint32_t address = 0;  ///< Passed on unchanged.
};

struct TimedRecord {
  Timestamp time;
  std::uint32_t address = 0;
};

/// Places the records of a YARP log in time: µs since the first one. Stamps wrap after 31 bits; in
/// a pause of minutes the host's time tells how often.
///
/// A stamp ahead of the previous one may be damaged, so its record waits for the next record, and
/// is believed unless the next stamp is older. A stamp more than 10 ms back may be damaged, or the
/// counter was reset: 64 such stamps in succession are a reset, after which time continues from its
/// last value. So a damaged stamp costs its own record alone. Records that are less out of order,
/// or in a packet that was sent earlier, keep their times.
class YarpEventClock {
 public:
  explicit YarpEventClock(double us_per_tick) : us_per_tick_(us_per_tick) {}

  /// Appends to `placed` the records whose time is now known: this one, or earlier ones that
  /// waited.
  void add(const StampedRecord& record, std::vector<TimedRecord>& placed);
  /// Call after the last record: appends the records that waited.
  void finish(std::vector<TimedRecord>& placed);

  /// Records left out since the last call, because their neighbours contradict their stamps.
  std::int64_t take_doubtful_records() { return std::exchange(doubtful_records_, 0); }

 private:
  void begin(std::vector<TimedRecord>& placed);
  void advance(const StampedRecord& record, std::vector<TimedRecord>& placed);
  void believe(const StampedRecord& record, std::int64_t step, std::vector<TimedRecord>& placed);
  void settle_ahead(const StampedRecord& next, std::vector<TimedRecord>& placed);
  bool settle_back(const StampedRecord& next, std::vector<TimedRecord>& placed);
  std::int64_t step_to(const StampedRecord& from, const StampedRecord& to) const;
  bool goes_on(const StampedRecord& from, const StampedRecord& to, double most_us) const;

  double us_per_tick_;
  std::vector<StampedRecord> first_;     // Wait until the first valid stamp is known.
  std::optional<StampedRecord> newest_;  // The newest believed record …
  std::int64_t ticks_ = 0;               // … and its time.
  std::optional<StampedRecord> ahead_;   // Waits for the next record.
  std::vector<StampedRecord> back_;      // Wait until a reset of the counter is certain.
  std::int64_t doubtful_records_ = 0;
};

}  // namespace puck
