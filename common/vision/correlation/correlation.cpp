#include "common/vision/correlation/correlation.h"

#include <algorithm>
#include <limits>

namespace puck {
namespace {

// The pixels that a kernel covers with its anchor on any of the candidates.
Region reach_of(const EllipseKernel& kernel, const Region& candidates) {
  return {candidates.x - kernel.anchor_x(), candidates.y - kernel.anchor_y(),
          candidates.width + kernel.width() - 1, candidates.height + kernel.height() - 1};
}

bool holds(const Region& outer, const Region& inner) { return outer.intersect(inner) == inner; }

}  // namespace

void Correlation::set_surface(ImageView<const std::uint8_t> surface, const Region& region) {
  surface_ = surface;
  region_ = region;
  ready_ = false;
  in_blocks_ = false;
}

void Correlation::cover(const Region& region) {
  sums_of_rows_.resize(region);
  const ImageView<std::uint8_t> pixels = sums_of_rows_.pixels();
  const Region shown = region.intersect(region_);
  std::fill(pixels.row(0), pixels.row(region.height), std::uint8_t{0});
  if (!shown.empty()) {
    blur_.apply(surface_, {shown.x - region_.x, shown.y - region_.y, shown.width, shown.height},
                pixels.part(shown.x - region.x, shown.y - region.y, shown.width, shown.height));
    sums_of_rows_.sum_up(shown.y - region.y, shown.bottom() - region.y);
  } else {
    sums_of_rows_.sum_up(0, 0);
  }
  ready_ = true;
}

void Correlation::cover_reach(const EllipseKernel& kernel, const Region& candidates) {
  const Region needed = reach_of(kernel, candidates);
  if (!ready_ || !holds(sums_of_rows_.place(), needed)) cover(needed);
}

void Correlation::correlate(const EllipseKernel& kernel, const Region& candidates,
                            CorrelationMap& out) {
  if (weigh(kernel, candidates, candidates, out)) return;
  measure(kernel, candidates, out);
}

double Correlation::correlate_lowest(const EllipseKernel& kernel, const Region& candidates,
                                     const Region& kept, CorrelationMap& out) {
  if (const auto lowest = weigh(kernel, candidates, kept, out)) return *lowest;
  measure(kernel, candidates, out);
  double lowest = std::numeric_limits<double>::infinity();
  for (int y = 0; y < candidates.height; ++y) {
    const double* row = out.response.row(y);
    lowest = std::min(lowest, *std::min_element(row, row + candidates.width));
  }
  return lowest;
}

std::optional<double> Correlation::weigh(const EllipseKernel& kernel, const Region& candidates,
                                         const Region& kept, CorrelationMap& out) {
  const auto& weights = kernel.whole_weights();
  if (!weights || candidates.empty()) return std::nullopt;
  cover_reach(kernel, candidates);
  const std::int32_t lowest =
      sweep_.sweep(sums_of_rows_, kernel, *weights, candidates, kept, totals_);
  out.region = kept;
  out.response.resize(kept.width, kept.height);
  for (int y = 0; y < kept.height; ++y) {
    const std::int32_t* from = totals_.row(kept.y + y);
    double* to = out.response.row(y);
    for (int x = 0; x < kept.width; ++x) to[x] = EllipseKernel::kWeightUnit * from[x];
  }
  return EllipseKernel::kWeightUnit * lowest;
}

void Correlation::measure(const EllipseKernel& kernel, const Region& candidates,
                          CorrelationMap& out) {
  out.region = candidates;
  out.response.resize(candidates.width, candidates.height);
  if (candidates.empty()) return;
  cover_reach(kernel, candidates);
  sweep_.sweep(sums_of_rows_, kernel, candidates, sums_);
  for (int y = 0; y < candidates.height; ++y) {
    const std::int32_t* canvas = sums_[0].row(candidates.y + y);
    const std::int32_t* outer = sums_[1].row(candidates.y + y);
    const std::int32_t* inner = sums_[2].row(candidates.y + y);
    double* to = out.response.row(y);
    for (int x = 0; x < candidates.width; ++x) {
      to[x] = kernel.response(canvas[x], outer[x], inner[x]);
    }
  }
}

void Correlation::sum_blocks() {
  if (!in_blocks_) blocks_.set_picture(surface_);
  in_blocks_ = true;
}

double Correlation::lower_bound(const EllipseKernel& kernel) {
  sum_blocks();
  const bool mirrors_once =
      surface_.width() > 2 * GaussianBlur::kRadius && surface_.height() > 2 * GaussianBlur::kRadius;
  if (!mirrors_once) return kernel.lowest_response();
  const auto most_in = [&](int width, int height) {
    const auto grey = static_cast<double>(
        blocks_.most_in(width + 2 * GaussianBlur::kRadius, height + 2 * GaussianBlur::kRadius));
    return GaussianBlur::kMostGain * grey + 0.5 * width * height;
  };
  return kernel.lowest_response(most_in(kernel.width(), kernel.height()),
                                most_in(kernel.inner_width(), kernel.inner_height()));
}

double Correlation::contrast_at(const EllipseKernel& kernel, int x, int y) {
  const Region place{x, y, 1, 1};
  cover_reach(kernel, place);
  sweep_.sweep(sums_of_rows_, kernel, place, sums_);
  return kernel.contrast(*sums_[0].row(y), *sums_[1].row(y), *sums_[2].row(y));
}

}  // namespace puck
