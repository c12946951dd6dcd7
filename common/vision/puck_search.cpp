#include "common/vision/puck_search.h"

#include <algorithm>
#include <cmath>

namespace puck {

PuckSearch::PuckSearch(SensorSize sensor, const KernelBankParams& kernels,
                       const DetectorParams& detector, const PuckSizeModel& size_model)
    : sensor_(sensor),
      size_model_(size_model),
      kernels_(kernels),
      detector_(detector, size_model) {}

Region PuckSearch::snapshot_region(const Region& search) const {
  if (search.empty()) return {};
  const int reach = std::max(detector_.reach(), kernels_.reach_beyond(search, size_model_));
  return search.inflated(reach + GaussianBlur::kRadius).intersect(Region::all_of(sensor_));
}

SearchResult PuckSearch::search(const SurfaceSnapshot& snapshot, const Region& search) {
  SearchResult result{snapshot.newest_event, search, {}};
  if (snapshot.region.empty()) return result;
  blur_.apply(snapshot.grey.view(), blurred_);
  picture_.set_picture(blurred_.view(), snapshot.region);
  for (const PuckDetector::Detection& found : detector_.detect(picture_, search, kernels_)) {
    // The score says the same for every preset, whatever its detection kernel answers.
    const double score = picture_.contrast_at(kernels_.nearest(size_model_.at(found.position)),
                                              static_cast<int>(std::lround(found.position.x)),
                                              static_cast<int>(std::lround(found.position.y)));
    result.candidates.push_back({found.position, score});
  }
  return result;
}

}  // namespace puck
