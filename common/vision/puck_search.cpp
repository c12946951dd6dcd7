#include "common/vision/puck_search.h"

#include <algorithm>
#include <cmath>

namespace puck {

PuckSearch::PuckSearch(SensorSize sensor, const PipelineParams& params,
                       const PuckSizeModel& size_model)
    : sensor_(sensor),
      size_model_(size_model),
      kernels_(params.kernels),
      detector_(params.detector, size_model),
      has_ring_(params.tracker.ring.enabled),
      ring_(sensor, params.tracker.ring, size_model, params.contour.calibration) {}

Region PuckSearch::snapshot_region(const Region& search) const {
  if (search.empty()) return {};
  const int reach = std::max(detector_.reach(), kernels_.reach_beyond(search, size_model_));
  return search.inflated(reach + GaussianBlur::kRadius).intersect(Region::all_of(sensor_));
}

SearchResult PuckSearch::search(const SurfaceSnapshot& snapshot, const Region& search) {
  SearchResult result{snapshot.newest_event, search, {}};
  if (snapshot.region.empty()) return result;
  picture_.set_surface(snapshot.grey.view(), snapshot.region);
  for (const PuckDetector::Detection& found : detector_.detect(picture_, search, kernels_)) {
    if (has_ring_) {
      // As the tracker will see the place: finer, and with the score that it goes by.
      const SoftRing::Fit fit = ring_.fit(snapshot.grey.view(), snapshot.region, found.position);
      result.candidates.push_back({fit.position, fit.score});
      continue;
    }
    // The score says the same for every preset, whatever its detection kernel answers.
    const double score = picture_.contrast_at(kernels_.nearest(size_model_.at(found.position)),
                                              static_cast<int>(std::lround(found.position.x)),
                                              static_cast<int>(std::lround(found.position.y)));
    result.candidates.push_back({found.position, score});
  }
  std::stable_sort(
      result.candidates.begin(), result.candidates.end(),
      [](const SearchCandidate& a, const SearchCandidate& b) { return a.score > b.score; });
  return result;
}

}  // namespace puck
