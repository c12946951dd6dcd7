#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "common/vision/interfaces/tracking_algorithm.h"
#include "common/vision/interfaces/tracking_pipeline.h"
#include "common/vision/make_pipeline.h"
#include "common/vision/paper/puck_search.h"
#include "common/vision/surface/fresh_pixels.h"
#include "common/vision/surface/surface.h"

namespace puck {

/// PUCK in one thread: surface, pipeline and searches, one after the other. Live, each of the three
/// has a thread of its own (runtime/). The result of a search is delivered at once, or after
/// SearchParams::search_delay_us, so the same events and calls give the same estimates, to the bit.
class SurfaceTracker final : public TrackingAlgorithm {
 public:
  /// Throws std::invalid_argument, naming the key, when a parameter is out of range.
  SurfaceTracker(SensorSize sensor, const PipelineParams& params, const PuckSizeModel& size_model);

  /// With the caller's pipeline; the parameters are those of the surface and the search.
  SurfaceTracker(SensorSize sensor, const PipelineParams& params, const PuckSizeModel& size_model,
                 std::unique_ptr<TrackingPipeline> pipeline);

  void update(const EventPacket& packet) override;
  PuckEstimate estimate() override;

 private:
  void take(Timestamp start, std::span<const Event> piece);
  PuckEstimate step();
  bool search_if_wanted();

  Surface surface_;
  std::optional<FreshPixels> fresh_;  // where searches ask for it
  std::unique_ptr<TrackingPipeline> pipeline_;
  PuckSearch search_;
  bool roi_only_;
  std::int64_t search_delay_us_;
  SurfaceSnapshot snapshot_;
  SurfaceSnapshot searched_;
  FreshRows searched_fresh_;
  std::optional<SearchResult> unanswered_;
};

}  // namespace puck
