#pragma once

#include <array>
#include <cstdint>

#include "common/messages/clock_offset.h"
#include "common/messages/host_now.h"
#include "common/messages/published_estimate.h"
#include "common/messages/single_publisher.h"
#include "common/table/motion_filter.h"
#include "common/table/table_geometry.h"
#include "common/table/table_view.h"

namespace puck {

struct EstimateGateParams {
  std::int64_t max_age_us = 100'000;          ///< Of the newest event used, unless the puck rests.
  std::int64_t max_clock_error_us = 200'000;  ///< Limit for the age of an estimate's utime.
  double margin_m = 0.05;                     ///< Estimates further off the table are rejected.
  double max_speed_m_s = 20;                  ///< Faster ones are rejected.
  double default_sigma_px = 2;                ///< For a tracker without covariance.
  /// Estimates whose width differs by more than this factor from that of a puck at their place on
  /// the table are rejected. Not checked for a tracker that gives no size.
  double size_tolerance = 2;
};

/// Result of the checks of an estimate.
enum class EstimateVerdict : std::uint8_t {
  kGood,
  kNotTracking,
  kStale,  ///< Its newest event is too old.
  kOffTable,
  kImplausible,     ///< Too fast, too uncertain, or of events in the future.
  kWrongSize,       ///< Far too wide or too narrow for a puck at its place.
  kBlind,           ///< The head has turned by an unknown angle.
  kMalformed,       ///< Not finite, or an invalid covariance.
  kBelated,         ///< Older than one before, but good: a measurement of the past.
  kLate,            ///< Late, a duplicate or a replay.
  kOtherPublisher,  ///< Another tracker is followed.
  kClock,           ///< Too old, or from the future, by the sender's clock.
  kClockUnknown,    ///< The tracker's clock is unknown or too uncertain.
};
inline constexpr std::size_t kEstimateVerdicts = 13;

/// `good`, `not_tracking`, …: as in the names of counters.
const char* to_string(EstimateVerdict verdict);

/// Whether the estimate is the newest one of the followed tracker; if not, it says nothing about
/// the present.
constexpr bool is_news(EstimateVerdict verdict) { return verdict <= EstimateVerdict::kMalformed; }

/// Checks estimates and projects the good ones onto the table. One thread.
class EstimateGate {
 public:
  /// Throws std::invalid_argument that names the key when a value is out of its range.
  EstimateGate(const EstimateGateParams& params, const TableGeometry& table);

  /// Fills `measurement` if the estimate is good or belated. `sender`: the clock of its session.
  /// `view`: the table in the image at the estimate's time; null: not known.
  EstimateVerdict judge(const PublishedEstimate& estimate, const HostNow& now,
                        const SenderClock& sender, const TableView* view,
                        TableMeasurement& measurement);

  std::int64_t count(EstimateVerdict verdict) const {
    return counts_[static_cast<std::size_t>(verdict)];
  }

 private:
  EstimateVerdict judge_order(const PublishedEstimate& estimate, const HostNow& now,
                              const SenderClock& sender);
  EstimateVerdict judge_content(const PublishedEstimate& estimate, const HostNow& now,
                                const ClockOffset& sender, const TableView* view,
                                TableMeasurement& measurement) const;
  bool has_size_of_puck(const PublishedEstimate& estimate, const TableView& view,
                        const TablePoint& position) const;

  EstimateGateParams params_;
  TableGeometry table_;
  SinglePublisher publisher_;
  std::array<std::int64_t, kEstimateVerdicts> counts_{};
};

}  // namespace puck
