#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/hypotheses/hypothesis.h"
#include "common/vision/hypotheses/near_cells.h"
#include "common/vision/interfaces/tracking_pipeline.h"
#include "common/vision/scene/background.h"
#include "common/vision/scene/noise_floor.h"
#include "common/vision/surface/event_history.h"

namespace puck {

/// Called with a hypothesis whose packet() has just become full, and the game's traits at that
/// time: for examples of evidence.
using PacketObserver = std::function<void(const Hypothesis&, const GameTraits&)>;

struct EvidencePipelineParams {
  EvidenceParams evidence;
  DecisionParams decision;
  /// If set, the tracker examines everything that resembles a puck: it searches all the time and
  /// removes each hypothesis after 0.1 s.
  PacketObserver on_packet;
};

/// The tracker of preset `default`: hypotheses about where the puck is, each a contour filter on
/// single events with a belief that it is the puck. Searches and manoeuvres propose them; packets
/// of evidence decide between them and "no puck". The same events handed over in the same pieces
/// give the same estimates, to the bit. One thread at a time.
class EvidencePipeline final : public TrackingPipeline {
 public:
  EvidencePipeline(SensorSize sensor, const EvidencePipelineParams& params,
                   const Region& detection_region, const PuckSizeModel& size_model,
                   const ContourCalibration& calibration);

  bool needs_events() const override { return true; }
  std::int64_t decision_period_us() const override { return kDecision_us; }
  void take(Timestamp start, std::span<const Event> events) override;
  Region region_needed() const override { return {}; }
  PuckEstimate step(const SurfaceSnapshot& snapshot) override;
  void work_off() override;
  SearchRequest search_wanted() override;
  void take(const SearchResult& result) override;

 private:
  // Sensor time between two decisions; and while all is quiet.
  static constexpr std::int64_t kDecision_us = 500;
  static constexpr std::int64_t kRareDecision_us = 2'000;

  // Variances and covariance of a place, px².
  struct Spread {
    double xx = 0;
    double xy = 0;
    double yy = 0;
  };

  void decide_before(std::int64_t time_us);
  void decide(std::int64_t time_us);
  bool is_quiet() const;
  void note_near();
  bool weigh(Hypothesis& hypothesis, std::int64_t time_us);
  bool is_seen(std::int64_t time_us) const;
  bool teaches() const;
  void forget(std::int64_t time_us);
  void compare_walls(const Hypothesis& hypothesis);
  std::optional<double> stands_still(const Hypothesis& hypothesis) const;
  double mark_prior(Pixel found) const;
  bool is_silent() const;
  double odds(const Hypothesis& hypothesis) const;
  void choose(std::int64_t time_us);
  void count_marks(std::int64_t time_us);
  bool is_sure() const;
  double seen_at(const Hypothesis& there) const;
  void note_seen_elsewhere();
  Spread spread_around(const Hypothesis& track) const;
  std::array<double, 16> covariance_of(const Hypothesis& track, const ContourFilter& now) const;
  void catch_up(Hypothesis& hypothesis);
  Hypothesis* add(const Hypothesis& hypothesis, std::int64_t time_us);
  void remove(std::size_t index);
  void offer_siblings(std::int64_t time_us);
  double reach_px(std::int64_t time_us) const;
  void plan_search(std::int64_t time_us);
  void merge(std::int64_t time_us);
  void prune(std::int64_t time_us);
  Region box_of(const Hypothesis& hypothesis) const;
  bool is_outside(const Hypothesis& hypothesis) const;

  SensorSize sensor_;
  Region detection_region_;
  PacketObserver on_packet_;
  TrackingContext context_;
  bool has_wall_;  // which may make events or not
  EventHistory history_;
  NoiseFloor noise_floor_;
  Background background_;
  NearCells near_;  // to the hypotheses

  std::vector<Hypothesis> all_;
  std::optional<std::size_t> main_;
  // Of the track, as of the last decision: later the others may lack events that it has.
  double seen_ = 0;
  Spread spread_;
  bool was_confirmed_ = false;
  std::optional<Pixel> left_image_;
  // Where and when the puck was last seen, and its Hypothesis::mark().
  Pixel last_seen_;
  double seen_mark_ = 1;
  std::int64_t seen_us_ = 0;

  std::vector<TimedEvent> piece_;   // near hypotheses
  bool is_owed_ = false;            // to all but the track
  std::size_t near_events_ = 0;     // since the last decision
  std::vector<TimedEvent> missed_;  // since the search began
  Region missed_in_;                // empty: no search runs
  SearchRequest wanted_;
  std::int64_t searched_us_ = std::numeric_limits<std::int64_t>::min() / 2;
  std::int64_t next_wide_us_ = 0;
  std::int64_t next_manoeuvre_us_ = 0;
  std::int64_t next_wall_us_ = 0;
  bool searched_other_wall_ = false;
  unsigned searches_ = 0;
  Region puck_;  // whose events are not the scene's
  std::int64_t now_us_ = 0;
  std::int64_t decided_us_ = 0;
};

}  // namespace puck
