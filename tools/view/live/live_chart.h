#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/events/timestamp.h"
#include "common/vision/interfaces/puck_estimate.h"
#include "tools/view/interface/view_state.h"
#include "tools/view/live/recent_truth.h"

namespace puck {

/// Samples of the charts at even sensor times, from what arrives. One thread.
class LiveChart {
 public:
  /// Events up to `newest`.
  void add_events(Timestamp newest, std::int64_t count);
  /// Empty: the tracker fell silent.
  void set_estimate(const std::optional<PuckEstimate>& estimate) { estimate_ = estimate; }
  void add_truth(const TruthRow& truth) { truth_.add(truth); }

  /// Ends all periods up to `time`, with the values known by now.
  void advance(Timestamp time);
  void clear();

  /// Oldest first.
  const std::deque<ChartSample>& samples() const { return samples_; }
  std::optional<TruthRow> truth_at(Timestamp time) const { return truth_.at(time); }
  /// Of the newest estimate, against the truth of its time.
  std::optional<double> error_px() const;

 private:
  void add_sample();

  RecentTruth truth_;
  std::optional<PuckEstimate> estimate_;
  std::optional<Timestamp> next_;  // End of the current period.
  std::int64_t events_ = 0;        // In this period.
  std::deque<ChartSample> samples_;
};

}  // namespace puck
