#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/vision/blob_witness.h"
#include "common/vision/challenger.h"
#include "common/vision/contour_calibration.h"
#include "common/vision/contour_track.h"
#include "common/vision/event_history.h"
#include "common/vision/puck_size_model.h"
#include "common/vision/refuted_places.h"
#include "common/vision/tracking_pipeline.h"

namespace puck {

struct ContourPipelineParams {
  ContourIngredients ingredients;
  ContourFilterParams filter;
  ContourCalibration calibration;
  /// Sensor time between two decisions.
  std::int64_t decision_us = 500;
  /// How long a track without support is still believed.
  std::int64_t coast_us = 50'000;
};

/// The tracker of preset `default`: a contour filter on single events does the fine work; the
/// correlation on the surface detects and searches; a blob, a twin at rest and what the search
/// finds challenge the track on the same events. A plain object like PuckPipeline; the same events
/// handed over in the same pieces give the same estimates, to the bit. One thread at a time.
class ContourPipeline final : public TrackingPipeline {
 public:
  /// `detection_region`: where the puck is looked for before it has been seen; empty: everywhere.
  ContourPipeline(SensorSize sensor, const ContourPipelineParams& params,
                  const Region& detection_region, const PuckSizeModel& size_model);

  Region events_needed() const override { return events_needed_; }
  std::int64_t decision_period_us() const override { return params_.decision_us; }
  void take(Timestamp start, std::span<const Event> events) override;
  Region region_needed() const override { return {}; }
  PuckEstimate step(const SurfaceSnapshot& snapshot) override;
  Region search_wanted() override;
  void take(const SearchResult& result) override;

 private:
  void take_event(const Event& event, std::int64_t time_us);
  void decide_before(std::int64_t time_us);
  void decide(std::int64_t time_us);
  void judge_main(std::int64_t time_us);
  void check_stop(std::int64_t time_us);
  void check_leaving();
  void consult_witness(std::int64_t time_us);
  void bear_twin(std::int64_t time_us);
  void bear_wall_twin(std::int64_t time_us);
  void challenge(Challenger::Kind kind, const ContourFilter::Start& start, std::int64_t time_us,
                 double wall_share, double search_score = 0);
  ContourFilter::Start shifted_for_wall(ContourFilter::Start start, double from, double to) const;
  void judge_challengers(std::int64_t time_us);
  void dismiss_hopeless(std::int64_t time_us);
  bool takes_over(Challenger& challenger, std::int64_t time_us);
  bool moves_by_itself(const Challenger& challenger, std::int64_t time_us) const;
  bool is_evident(const Challenger& challenger, std::int64_t time_us) const;
  bool is_convincing(const Challenger& challenger, std::int64_t time_us) const;
  void confirm_first(std::int64_t time_us);
  void enthrone(std::size_t index, std::int64_t time_us);
  void make_room();
  std::int64_t wide_search_period_us() const;
  void plan_search(std::int64_t time_us);
  void plan_events();
  void judge_state(std::int64_t time_us);
  bool witness_agrees() const;
  bool is_quiet() const;

  SensorSize sensor_;
  ContourPipelineParams params_;
  Region detection_region_;
  ContourContext context_;
  EventHistory history_;

  std::optional<ContourTrack> main_;
  BlobWitness witness_{Pixel{}};
  std::vector<Challenger> challengers_;
  RefutedPlaces refuted_;

  TrackState state_ = TrackState::kSearching;
  bool resting_ = false;
  std::optional<Pixel> left_image_;
  std::int64_t now_us_ = 0;
  std::int64_t decided_us_ = 0;
  std::int64_t good_us_ = 0;       // when the main track was last good
  std::int64_t sound_us_ = 0;      // when it was last beyond doubt
  std::int64_t moving_us_ = 0;     // for how long it has been sound and fast
  bool is_proven_ = false;         // it has moved as nothing but the puck does
  bool was_weakly_found_ = false;  // … by little evidence
  std::int64_t found_us_ = 0;      // when the search found it
  std::int64_t trust_us_ = 0;      // how much the main track is trusted to be the puck's
  std::int64_t held_us_ = 0;       // when it was last good or at rest
  std::int64_t agreed_us_ = 0;     // when the witness last agreed with it
  std::int64_t twin_us_ = 0;       // when the last twin was born
  std::int64_t witness_us_ = 0;    // when the witness last spoke up
  std::int64_t wall_twin_us_ = 0;
  std::int64_t searching_since_us_ = -1;  // when the first search began
  std::int64_t next_search_us_ = 0;
  std::int64_t wide_searched_us_ = 0;
  Region search_;           // wanted now; empty: none
  bool searching_ = false;  // given out, not answered yet
  Region events_needed_;
};

}  // namespace puck
