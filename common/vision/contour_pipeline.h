#pragma once

#include <cstdint>
#include <optional>

#include "common/events/sensor_size.h"
#include "common/vision/background.h"
#include "common/vision/challengers.h"
#include "common/vision/contour_calibration.h"
#include "common/vision/contour_track.h"
#include "common/vision/event_history.h"
#include "common/vision/held_rest.h"
#include "common/vision/left_behind.h"
#include "common/vision/missed_events.h"
#include "common/vision/noise_floor.h"
#include "common/vision/puck_size_model.h"
#include "common/vision/scene_rest.h"
#include "common/vision/search_plan.h"
#include "common/vision/seen_score.h"
#include "common/vision/settling.h"
#include "common/vision/side_view.h"
#include "common/vision/sighting_trails.h"
#include "common/vision/sought_wall.h"
#include "common/vision/track_standing.h"
#include "common/vision/track_trust.h"
#include "common/vision/tracking_pipeline.h"
#include "common/vision/twins.h"
#include "common/vision/wall_height.h"
#include "common/vision/way_back.h"
#include "common/vision/witness_check.h"

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
  SearchRequest search_wanted() override;
  void take(const SearchResult& result) override;

 private:
  void take_event(const Event& event, std::int64_t time_us);
  void decide_before(std::int64_t time_us);
  void decide(std::int64_t time_us);
  void judge_main(std::int64_t time_us);
  void return_if_left_behind(std::int64_t time_us);
  bool is_unseen(std::int64_t time_us) const;
  void challenge_main(std::int64_t time_us);
  /// The main track is the puck's beyond doubt, so that its opinion on the side wall is, too.
  bool shows_wall() const;
  bool shows_plain_face() const;
  void forget_looks();
  void watch_sides(std::int64_t time_us);
  void watch_exit(std::int64_t time_us);
  void learn_wall_height(std::int64_t passed_us);
  ClaimContext claim_context() const;
  bool head_turns() const;
  bool head_rests() const;
  bool rest_may_be_wrong() const;
  /// Whether what is found where the main track is challenges it.
  bool is_tried_afresh() const;
  void find_first(std::int64_t time_us);
  void enthrone(const Challenger& challenger, std::int64_t time_us);
  void correct_by(Pixel main);
  void plan_search(std::int64_t time_us);
  void plan_events(std::int64_t time_us);
  /// Whether the main track must not move.
  bool keeps_still() const { return standing_.is_resting() || held_rest_.is_held(); }

  SensorSize sensor_;
  ContourPipelineParams params_;
  ContourContext context_;
  EventHistory history_;

  std::optional<ContourTrack> main_;
  TrackTrust trust_;
  TrackStanding standing_;
  Settling settling_;
  HeldRest held_rest_;
  SceneRest scene_rest_;
  LeftBehind left_behind_;
  WitnessCheck witness_;
  Twins twins_;
  Challengers challengers_;
  MissedEvents missed_;
  SearchPlan search_plan_;
  SoughtWall sought_wall_;
  WallHeight wall_height_;
  double searched_wall_share_ = 0;  // SearchRequest::other_wall_share
  SeenScore seen_score_;
  SightingTrails trails_;
  SearchResult found_;
  Background background_;
  NoiseFloor noise_floor_;
  SideWatch side_watch_;
  WayBack way_back_;

  std::int64_t now_us_ = 0;
  std::int64_t decided_us_ = 0;
  Region events_needed_;
  Region near_;          // what the tracks take of it
  bool measures_noise_;  // all events of the image are wanted for it
  bool watches_background_ = false;
  bool watches_closely_ = false;      // without naps
  bool consults_background_ = false;  // whether the head turns is asked of it
  Region puck_;                       // whose events are not the background's
};

}  // namespace puck
