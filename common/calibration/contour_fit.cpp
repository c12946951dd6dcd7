#include "common/calibration/contour_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "common/calibration/median.h"
#include "common/calibration/robust_sigma.h"

namespace puck {
namespace {

using Parameters = Eigen::Vector4d;  // Lag in ms, wall's share, growth and trail in px.

constexpr std::size_t kFewestEvents = 1000;
constexpr double kLargestErrorUs = 50;
constexpr double kGatePx = 4;
constexpr int kIterations = 30;
constexpr double kSmallestStep = 1e-5;
constexpr int kParts = 20;
// Scale of Cauchy's weight, in standard deviations: the weight is 1/2 there. Nearly as efficient as
// least squares for normal errors.
constexpr double kCauchy = 2.385;
constexpr double kSmallestSpreadPx = 0.05;
// Prior standard deviation of each parameter around its default, with the weight of a single event.
const Parameters kPriorSigma(1, 0.3, 2, 0.2);
// With uniform speeds, lag and trail cannot be separated.
const Parameters kPriorSigmaFixedTrail(1, 0.3, 2, 1e-9);
// Step of the numerical derivatives.
constexpr double kStep = 1e-3;

ContourCalibration calibration_of(const Parameters& p) { return {1000 * p(0), p(1), p(2), p(3)}; }

Parameters parameters_of(const ContourCalibration& c) {
  return {c.lag_us / 1000, c.wall_share, c.grow_px, c.trail_px};
}

struct Residual {
  double value_px = 0;  // Positive: outside the expected ring.
  double normal_speed_px_s = 0;
  double normal_y = 0;
};

// Residuals of the samples under a calibration.
class Expectation {
 public:
  Expectation(const ContourSamples& samples, const Parameters& p)
      : calibration_(calibration_of(p)), contour_(samples.contour(calibration_)) {}

  Residual residual_of(const ContourSample& sample) const {
    const ContourOffset offset =
        contour_.ring_at(sample.centre, calibration_.wall_share).offset(sample.dx, sample.dy, 0);
    const double speed = offset.normal_x * sample.velocity.x + offset.normal_y * sample.velocity.y;
    return {offset.distance_px + calibration_.behind_px(speed), speed, offset.normal_y};
  }

 private:
  ContourCalibration calibration_;
  PuckContour contour_;
};

double spread_of(const ContourSamples& samples, const Parameters& p) {
  const Expectation expectation(samples, p);
  std::vector<double> sizes;
  for (const ContourSample& sample : samples.samples()) {
    const double size = std::abs(expectation.residual_of(sample).value_px);
    if (size < kGatePx) sizes.push_back(size);
  }
  return std::max(kSigmaOfMedian * median(sizes), kSmallestSpreadPx);
}

// Normal equations N step = g of the linearised, weighted problem.
struct NormalEquations {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Parameters side = Parameters::Zero();

  NormalEquations& operator+=(const NormalEquations& other) {
    matrix += other.matrix;
    side += other.side;
    return *this;
  }
};

NormalEquations prior_of(const Parameters& p, double spread_px, const Parameters& freedom) {
  NormalEquations prior;
  const Parameters off = parameters_of(ContourCalibration{}) - p;
  for (int i = 0; i < 4; ++i) {
    const double weight = spread_px / freedom(i);
    prior.matrix(i, i) = weight * weight;
    prior.side(i) = off(i) * weight * weight;
  }
  return prior;
}

// Normal equations of some of the samples.
NormalEquations equations_of(const ContourSamples& samples, std::span<const ContourSample> some,
                             const Parameters& p, double spread_px) {
  const Expectation expectation(samples, p);
  std::vector<Expectation> moved;
  for (int i = 0; i < 4; ++i) moved.emplace_back(samples, p + kStep * Parameters::Unit(i));
  NormalEquations sum;
  const double scale = kCauchy * spread_px;
  for (const ContourSample& sample : some) {
    const Residual r = expectation.residual_of(sample);
    if (std::abs(r.value_px) > kGatePx) continue;
    Parameters slope;
    for (int i = 0; i < 4; ++i) {
      const double there = moved[static_cast<std::size_t>(i)].residual_of(sample).value_px;
      slope(i) = (there - r.value_px) / kStep;
    }
    const double ratio = r.value_px / scale;
    const double weight = 1 / (1 + ratio * ratio);
    sum.matrix += weight * slope * slope.transpose();
    sum.side -= weight * r.value_px * slope;
  }
  return sum;
}

// Jackknife over the parts of the recording: the scatter of one more step without each part gives
// the error, also when the events of a part are correlated.
Parameters standard_error_of(const ContourSamples& samples, const Parameters& p, double spread_px,
                             const Parameters& freedom) {
  std::array<NormalEquations, kParts> parts;
  NormalEquations all = prior_of(p, spread_px, freedom);
  for (std::size_t i = 0; i < kParts; ++i) {
    const std::span<const ContourSample> events = samples.samples();
    const std::size_t begin = events.size() * i / kParts;
    const std::size_t end = events.size() * (i + 1) / kParts;
    parts[i] = equations_of(samples, events.subspan(begin, end - begin), p, spread_px);
    all += parts[i];
  }
  Eigen::Matrix4d scatter = Eigen::Matrix4d::Zero();
  for (const NormalEquations& part : parts) {
    const Parameters step = (all.matrix - part.matrix).ldlt().solve(all.side - part.side);
    scatter += step * step.transpose();
  }
  scatter *= (kParts - 1.0) / kParts;
  const Eigen::Matrix4d independent = spread_px * spread_px * all.matrix.inverse();
  return (scatter + independent).diagonal().cwiseSqrt();
}

void describe(const ContourSamples& samples, const Parameters& p, ContourFit& fit) {
  const Expectation expectation(samples, p);
  std::vector<double> front;
  std::vector<double> back;
  std::vector<double> upper;
  std::vector<double> lower;
  std::vector<double> speeds;
  for (const ContourSample& sample : samples.samples()) {
    const Residual r = expectation.residual_of(sample);
    if (std::abs(r.value_px) > kGatePx) continue;
    (r.normal_speed_px_s > 0 ? front : back).push_back(r.value_px);
    if (r.normal_y < -0.7) upper.push_back(r.value_px);
    if (r.normal_y > 0.7) lower.push_back(r.value_px);
    speeds.push_back(std::abs(r.normal_speed_px_s));
  }
  fit.events = speeds.size();
  fit.front_px = median(front);
  fit.back_px = median(back);
  fit.upper_px = median(upper);
  fit.lower_px = median(lower);
  const auto fast = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() * 9 / 10);
  std::nth_element(speeds.begin(), fast, speeds.end());
  fit.fast_px_s = *fast;
}

ContourFit fit_freely(const ContourSamples& samples, const Parameters& freedom) {
  Parameters p = parameters_of(ContourCalibration{});
  double spread_px = spread_of(samples, p);
  ContourFit fit;
  fit.spread_before_px = spread_px;
  for (int i = 0; i < kIterations; ++i) {
    NormalEquations equations = equations_of(samples, samples.samples(), p, spread_px);
    equations += prior_of(p, spread_px, freedom);
    const Parameters step = equations.matrix.ldlt().solve(equations.side);
    p += step;
    spread_px = spread_of(samples, p);
    if (step.cwiseAbs().maxCoeff() < kSmallestStep) break;
  }
  fit.spread_px = spread_px;
  fit.calibration = calibration_of(p);
  fit.standard_error = calibration_of(standard_error_of(samples, p, spread_px, freedom));
  describe(samples, p, fit);
  fit.calibration.lean_deg = samples.lean_deg();
  return fit;
}

}  // namespace

ContourFit fit_contour(const ContourSamples& samples) {
  if (samples.samples().size() < kFewestEvents) {
    throw std::invalid_argument("only " + std::to_string(samples.samples().size()) +
                                " events of the contour of a moving puck, at least " +
                                std::to_string(kFewestEvents) + " are needed");
  }
  ContourFit fit = fit_freely(samples, kPriorSigma);
  if (!(fit.standard_error.lag_us < kLargestErrorUs))
    fit = fit_freely(samples, kPriorSigmaFixedTrail);
  if (!(fit.standard_error.lag_us < kLargestErrorUs)) {
    throw std::invalid_argument(
        "the puck is too slow to determine the lag: nine tenths of its contour's events move at "
        "less "
        "than " +
        std::to_string(std::lround(fit.fast_px_s)) + " px/s, which leaves the lag open by " +
        std::to_string(std::lround(fit.standard_error.lag_us)) + " us");
  }
  return fit;
}

}  // namespace puck
