#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace puck {

/// The measure of a correlation at a candidate.
enum class KernelMeasure : std::uint8_t {
  kWeightedSum,  ///< The sum of weight times grey: the paper's convolution.
  kContrast,     ///< EllipseKernel::contrast, comparable at every size and brightness.
};

/// Weights of the pixels inside the puck's ring, on it and around it. Boundaries are in squared
/// normalised radius, ((x − cx) / a)² + ((y − cy) / b)², which is 1 on the ellipse.
struct KernelProfile {
  double inner_boundary = 0.4;
  double outer_boundary = 0.8;
  double inside_weight = -1;
  double ring_weight = 3;
  double outside_weight = -0.2;
  KernelMeasure measure = KernelMeasure::kWeightedSum;
};

/// Position of a kernel's ellipse on its canvas, px from the canvas's first pixel.
struct KernelGeometry {
  int canvas_width = 0;
  int canvas_height = 0;
  double origin_x = 0;  ///< Centre of the ellipse.
  double origin_y = 0;
  double semi_x = 0;  ///< Semi-axes.
  double semi_y = 0;
  int anchor_x = 0;  ///< The pixel at the candidate's position.
  int anchor_y = 0;
};

/// The paper's elliptical kernel: a ring that the puck's contour fills, with a penalty for events
/// inside it and around it (paper, Section III-B). It is kept as three filled shapes — canvas,
/// outer and inner ellipse —, each a run of pixels a row, because a run costs two look-ups in a
/// table of row sums however long it is.
class EllipseKernel {
 public:
  /// Columns first … last − 1 of a canvas row.
  struct Run {
    std::int16_t first = 0;
    std::int16_t last = 0;
  };

  /// Sums over a wider canvas could not be swept (KernelSweep).
  static constexpr int kWidest = 128;

  /// Throws std::invalid_argument when the canvas is empty or too wide, or the ellipse is empty.
  EllipseKernel(const KernelGeometry& geometry, const KernelProfile& profile);

  int width() const { return geometry_.canvas_width; }
  int height() const { return geometry_.canvas_height; }
  int anchor_x() const { return geometry_.anchor_x; }
  int anchor_y() const { return geometry_.anchor_y; }

  /// The run of the outer and of the inner ellipse in a canvas row; empty runs have first = last.
  Run outer_run(int row) const { return outer_[static_cast<std::size_t>(row)]; }
  Run inner_run(int row) const { return inner_[static_cast<std::size_t>(row)]; }

  /// Weights of the sums over the canvas, the outer and the inner ellipse.
  struct WholeWeights {
    std::int16_t canvas = 0;
    std::int16_t outer = 0;
    std::int16_t inner = 0;
  };

  /// The weights of the three sums in units of kWeightUnit, if the measure is a weighted sum, all
  /// three are whole numbers and the total fits into 32 bits for every picture: the weighted sum is
  /// then an exact integer, and comparisons do not depend on rounding.
  const std::optional<WholeWeights>& whole_weights() const { return whole_weights_; }
  static constexpr double kWeightUnit = 0.2;

  KernelMeasure measure() const { return measure_; }

  /// Lower bound on the response for any picture.
  double lowest_response() const { return lowest_response_; }
  /// Lower bound on the weighted sum for any picture with at most so much grey on the canvas and in
  /// the rectangle around the inner ellipse.
  double lowest_response(double canvas_sum, double inner_sum) const {
    return std::max(lowest_response_, canvas_floor_ * canvas_sum + inner_floor_ * inner_sum);
  }

  /// Size of the rectangle around the inner ellipse.
  int inner_width() const { return inner_width_; }
  int inner_height() const { return inner_height_; }

  int inside_pixels() const { return inside_pixels_; }
  int ring_pixels() const { return ring_pixels_; }
  int outside_pixels() const { return outside_pixels_; }

  /// The profile's measure, from the sums of grey over the canvas and the two ellipses.
  double response(double canvas_sum, double outer_sum, double inner_sum) const {
    return measure_ == KernelMeasure::kContrast ? contrast(canvas_sum, outer_sum, inner_sum)
                                                : weighted_sum(canvas_sum, outer_sum, inner_sum);
  }

  double weighted_sum(double canvas_sum, double outer_sum, double inner_sum) const {
    return canvas_factor_ * canvas_sum + outer_factor_ * outer_sum + inner_factor_ * inner_sum;
  }

  /// Similarity to a puck for any weights: (r − b) / (r + b + doubt), with r the ring's mean grey,
  /// b the mean of the inside's and the outside's, and the doubt 5 % of full grey, so that a few
  /// stray events score low. 0 without contrast; it approaches 1 for a bright ring on dark ground.
  /// Comparable at every size.
  double contrast(double canvas_sum, double outer_sum, double inner_sum) const {
    const double ring = (outer_sum - inner_sum) * per_ring_pixel_;
    const double background =
        0.5 * (inner_sum * per_inside_pixel_ + (canvas_sum - outer_sum) * per_outside_pixel_);
    return std::max(0.0, (ring - background) / (ring + background + kDoubt));
  }

 private:
  static constexpr double kDoubt = 0.05 * 255;

  KernelGeometry geometry_;
  std::vector<Run> outer_;
  std::vector<Run> inner_;
  int inside_pixels_ = 0;
  int ring_pixels_ = 0;
  int outside_pixels_ = 0;
  KernelMeasure measure_;
  double per_inside_pixel_ = 0;
  double per_ring_pixel_ = 0;
  double per_outside_pixel_ = 0;
  double canvas_factor_ = 0;
  double outer_factor_ = 0;
  double inner_factor_ = 0;
  double lowest_response_ = 0;
  double canvas_floor_ = 0;  // the lowest weight outside the inner ellipse, at most 0
  double inner_floor_ = 0;   // difference inside it, at most 0
  int inner_width_ = 0;
  int inner_height_ = 0;
  std::optional<WholeWeights> whole_weights_;
};

}  // namespace puck
