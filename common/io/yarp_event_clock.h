#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/events/timestamp.h"

namespace puck {

/// A record of a YARP log whose stamp counts ticks.
struct StampedRecord {
  std::uint32_t stamp = 0;    ///< 31 bits; wraps.
  double host_time_s = 0;     ///< When its packet was sent.
  std::uint32_t address = 0;  ///< Handed through.
};

struct TimedRecord {
  Timestamp time;
  std::uint32_t address = 0;
};

/// Places the records of a YARP log in time: µs since the first one. Stamps wrap after 31 bits; in
/// a pause of minutes the host's time tells how often.
///
/// A stamp ahead of the one before may be a damaged one, so its record waits for the next: it is
/// believed unless that one is older. A stamp more than 10 ms back may be damaged or the beginning
/// of a new count: it is believed if the next 63 go on from it, and time then goes on from where it
/// was. So a damaged stamp costs its own record alone. Records that come out of turn by less, or in
/// a packet that was sent earlier, are placed at the times that they have.
class YarpEventClock {
 public:
  explicit YarpEventClock(double us_per_tick) : us_per_tick_(us_per_tick) {}

  /// Appends to `placed` what can be placed by now, this record or earlier ones that waited.
  void add(const StampedRecord& record, std::vector<TimedRecord>& placed);
  /// No more records will come: appends what waited.
  void finish(std::vector<TimedRecord>& placed);

  /// Records left out because their neighbours contradict their stamps.
  std::int64_t doubtful_records() const { return doubtful_records_; }

 private:
  void begin(std::vector<TimedRecord>& placed);
  void advance(const StampedRecord& record, std::vector<TimedRecord>& placed);
  void believe(const StampedRecord& record, std::int64_t step, std::vector<TimedRecord>& placed);
  void settle_ahead(const StampedRecord& next, std::vector<TimedRecord>& placed);
  bool settle_back(const StampedRecord& next, std::vector<TimedRecord>& placed);
  std::int64_t step_to(const StampedRecord& from, const StampedRecord& to) const;
  bool goes_on(const StampedRecord& from, const StampedRecord& to, double most_us) const;

  double us_per_tick_;
  std::vector<StampedRecord> first_;     // Until there are enough to tell where to begin.
  std::optional<StampedRecord> newest_;  // That was believed …
  std::int64_t ticks_ = 0;               // … and its time.
  std::optional<StampedRecord> ahead_;   // Waits for the next one.
  std::vector<StampedRecord> back_;      // Wait until they are enough to be a new count.
  std::int64_t doubtful_records_ = 0;
};

}  // namespace puck
