#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/vision/background.h"
#include "common/vision/event_history.h"
#include "common/vision/hypothesis.h"
#include "common/vision/noise_floor.h"
#include "common/vision/puck_size_model.h"
#include "common/vision/tracking_pipeline.h"

namespace puck {

struct EvidencePipelineParams {
  ContourFilterParams filter;
  ContourCalibration calibration;
  EvidenceParams evidence;
  DecisionParams decision;
  /// Sensor time between two decisions.
  std::int64_t decision_us = 500;
};

/// The tracker of preset `evidence`, which is to become `default`: hypotheses about where the puck
/// is, each a contour filter on single events with a belief that it is the puck. Searches and
/// manoeuvres propose them; packets of evidence decide between them and "no puck". The same events
/// handed over in the same pieces give the same estimates, to the bit. One thread at a time.
class EvidencePipeline final : public TrackingPipeline {
 public:
  EvidencePipeline(SensorSize sensor, const EvidencePipelineParams& params,
                   const Region& detection_region, const PuckSizeModel& size_model);

  Region events_needed() const override { return Region::all_of(sensor_); }
  std::int64_t decision_period_us() const override { return decision_us_; }
  void take(Timestamp start, std::span<const Event> events) override;
  Region region_needed() const override { return {}; }
  PuckEstimate step(const SurfaceSnapshot& snapshot) override;
  SearchRequest search_wanted() override;
  void take(const SearchResult& result) override;

 private:
  void decide_before(std::int64_t time_us);
  void decide(std::int64_t time_us);
  bool is_seen(std::int64_t time_us) const;
  bool teaches() const;
  void forget(std::int64_t time_us);
  void compare_walls(const Hypothesis& hypothesis);
  double own_motion_of(const Hypothesis& hypothesis, std::int64_t passed_us) const;
  double odds(const Hypothesis& hypothesis) const;
  void choose(std::int64_t time_us);
  bool is_sure() const;
  double seen_here() const;
  double seen_elsewhere(const Hypothesis& hypothesis) const;
  void catch_up(Hypothesis& hypothesis);
  Hypothesis* add(const Hypothesis& hypothesis, std::int64_t time_us);
  void remove(std::size_t index);
  void offer_siblings(std::int64_t time_us);
  void plan_search(std::int64_t time_us);
  void prune(std::int64_t time_us);
  Region box_of(const Hypothesis& hypothesis) const;
  bool is_outside(const Hypothesis& hypothesis) const;

  SensorSize sensor_;
  Region detection_region_;
  std::int64_t decision_us_;
  TrackingContext context_;
  bool has_wall_;  // which may make events or not
  EventHistory history_;
  NoiseFloor noise_floor_;
  Background background_;

  std::vector<Hypothesis> all_;
  std::optional<std::size_t> main_;
  bool was_confirmed_ = false;
  std::optional<Pixel> left_image_;
  // Where and when the puck was last seen.
  Pixel seen_at_;
  std::int64_t seen_us_ = 0;

  std::vector<TimedEvent> piece_;
  std::vector<TimedEvent> missed_;  // since the search began
  Region missed_in_;                // empty: no search runs
  SearchRequest wanted_;
  std::int64_t next_search_us_ = 0;
  std::int64_t next_wide_us_ = 0;
  std::int64_t next_manoeuvre_us_ = 0;
  std::int64_t next_wall_us_ = 0;
  bool searched_other_wall_ = false;
  Region puck_;  // whose events are not the scene's
  std::int64_t now_us_ = 0;
  std::int64_t decided_us_ = 0;
};

}  // namespace puck
