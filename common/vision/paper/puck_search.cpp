#include "common/vision/paper/puck_search.h"

#include <algorithm>
#include <cmath>

#include "common/vision/correlation/gaussian_blur.h"

namespace puck {
namespace {

PuckSizeModel lowered(PuckSizeModel model, double share_of_width) {
  model.unseen_of_width = share_of_width;
  return model;
}

}  // namespace

PuckSearch::Look::Look(SensorSize sensor, const SearchParams& params,
                       const PuckSizeModel& size_model, double kernel_wall_share, bool other_wall)
    : contour_size(lowered(size_model, kernel_wall_share)),
      rise_of_width(kernel_wall_share / 2),
      detector(params.detector, contour_size),
      ring(params.make_ring(sensor, size_model, other_wall)) {}

// The kernels of the calibrated wall have the puck's size, as in the paper.
PuckSearch::PuckSearch(SensorSize sensor, const SearchParams& params,
                       const PuckSizeModel& size_model)
    : sensor_(sensor),
      kernels_(params.kernels),
      calibrated_(sensor, params, params.sizes_of(size_model), 0, false),
      other_wall_(sensor, params, params.sizes_of(size_model),
                  params.contour.other_wall_share(params.sizes_of(size_model)), true) {}

Region PuckSearch::snapshot_region(const Region& search) const {
  if (search.empty()) return {};
  const int reach = std::max({calibrated_.detector.reach(),
                              kernels_.reach_beyond(search, calibrated_.contour_size),
                              kernels_.reach_beyond(search, other_wall_.contour_size)});
  return search.inflated(reach + GaussianBlur::kRadius).intersect(Region::all_of(sensor_));
}

SearchResult PuckSearch::search(const SurfaceSnapshot& snapshot, const SearchRequest& request) {
  SearchResult result{snapshot.newest_event, request, {}};
  if (snapshot.region.empty()) return result;
  picture_.set_surface(snapshot.grey.view(), snapshot.region);
  Look& look = request.other_wall ? other_wall_ : calibrated_;
  for (const PuckDetector::Detection& found :
       look.detector.detect(picture_, request.region, kernels_)) {
    result.candidates.push_back(candidate_at(snapshot, look, found.position));
  }
  std::stable_sort(
      result.candidates.begin(), result.candidates.end(),
      [](const SearchCandidate& a, const SearchCandidate& b) { return a.score > b.score; });
  return result;
}

SearchCandidate PuckSearch::candidate_at(const SurfaceSnapshot& snapshot, Look& look,
                                         Pixel detected) {
  const PuckSize size = look.contour_size.at(detected);
  const Pixel centre{detected.x, detected.y + look.rise_of_width * size.width};
  if (look.ring) {
    // As the tracker's step: finer, and with the tracker's score.
    const SoftRing::Fit fit = look.ring->fit(snapshot.grey.view(), snapshot.region, centre);
    return {fit.position, fit.score};
  }
  // The contrast is comparable between presets, unlike the detection kernel's response.
  const double score =
      picture_.contrast_at(kernels_.nearest(size), static_cast<int>(std::lround(detected.x)),
                           static_cast<int>(std::lround(detected.y)));
  return {centre, score};
}

}  // namespace puck
