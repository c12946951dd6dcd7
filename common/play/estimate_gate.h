#pragma once

#include <array>
#include <cstdint>

#include "common/messaging/channels.h"
#include "common/messaging/clock_offset.h"
#include "common/messaging/host_now.h"
#include "common/messaging/single_publisher.h"
#include "common/table/motion_filter.h"
#include "common/table/table_geometry.h"
#include "common/table/table_view.h"

namespace puck {

struct EstimateGateParams {
  std::int64_t max_age_us = 100'000;  ///< Of the newest event used; a resting puck's may be older.
  std::int64_t max_clock_error_us = 200'000;  ///< Of an estimate's utime, by its sender's clock.
  double margin_m = 0.05;                     ///< A puck further off the table is not believed.
  double max_speed_m_s = 20;                  ///< Nor is a faster one.
  double default_sigma_px = 2;                ///< Where a tracker gives no covariance.
  /// A puck that seems wider or narrower by more than this factor than one would at its place on
  /// the table is not believed. A tracker that gives no size is not asked.
  double size_tolerance = 2;
};

/// What an estimate is good for.
enum class EstimateVerdict : std::uint8_t {
  kGood,
  kNotTracking,
  kStale,  ///< Its newest event is too old.
  kOffTable,
  kImplausible,     ///< Too fast, too unsure, or of events that are yet to come.
  kWrongSize,       ///< Far too wide or too narrow for its place: something else, or elsewhere.
  kBlind,           ///< The head has turned, and where to is not known.
  kMalformed,       ///< Not finite, or a covariance that is none.
  kBelated,         ///< Overtaken by a newer one, but good: says something about then.
  kLate,            ///< Late, a duplicate or a replay.
  kOtherPublisher,  ///< Another tracker is followed.
  kClock,           ///< Old, or from the future, by its own clock.
  kClockUnknown,    ///< The tracker's clock is not known, or not well enough.
};
inline constexpr std::size_t kEstimateVerdicts = 13;

/// `good`, `not_tracking`, …: as in the names of counters.
const char* to_string(EstimateVerdict verdict);

/// Whether the estimate is the newest word of the tracker that is followed; if not, it says nothing
/// about now.
constexpr bool is_news(EstimateVerdict verdict) { return verdict <= EstimateVerdict::kMalformed; }

/// Believes estimates or not, and carries the good ones to the table. One thread.
class EstimateGate {
 public:
  /// Throws std::invalid_argument that names the key when a value is out of its range.
  EstimateGate(const EstimateGateParams& params, const TableGeometry& table);

  /// Fills `measurement` when the estimate is good or belated. `sender`: the clock of its session.
  /// `view`: the table in the image at its time; null where that is not known.
  EstimateVerdict judge(const puck_estimate_t& estimate, const HostNow& now,
                        const SenderClock& sender, const TableView* view,
                        TableMeasurement& measurement);

  std::int64_t count(EstimateVerdict verdict) const {
    return counts_[static_cast<std::size_t>(verdict)];
  }

 private:
  EstimateVerdict judge_order(const puck_estimate_t& estimate, const HostNow& now,
                              const SenderClock& sender);
  EstimateVerdict judge_content(const puck_estimate_t& estimate, const HostNow& now,
                                const ClockOffset& sender, const TableView* view,
                                TableMeasurement& measurement) const;
  bool has_size_of_puck(const puck_estimate_t& estimate, const TableView& view,
                        const TablePoint& position) const;

  EstimateGateParams params_;
  TableGeometry table_;
  SinglePublisher publisher_;
  std::array<std::int64_t, kEstimateVerdicts> counts_{};
};

}  // namespace puck
