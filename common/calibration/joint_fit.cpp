#include "common/calibration/joint_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include <Eigen/Dense>

#include "common/calibration/refuse.h"

namespace puck {
namespace {

// Closer places are repeated measurements of one place.
constexpr double kSamePlaceM = 1e-4;
constexpr std::size_t kLeastPlaces = 4;
constexpr double kShortestM = 0.02;
constexpr int kMostIntervals = 16;

void check(std::span<const JointPair> pairs, const JointFitParams& params) {
  if (pairs.empty()) refuse("there are no pairs");
  for (const JointPair& pair : pairs) {
    if (pair.deg.size() != pairs.front().deg.size() || pair.deg.empty()) {
      refuse("the pairs must all have the same joints");
    }
    if (!std::isfinite(pair.y_m) || !std::all_of(pair.deg.begin(), pair.deg.end(),
                                                 [](double deg) { return std::isfinite(deg); })) {
      refuse("a pair has a number that is not finite");
    }
  }
  if (!(params.margin_deg >= 0)) refuse("the margin must not be negative");
}

// Sorted by place; repeated measurements of one place are averaged.
std::vector<JointPair> places_of(std::span<const JointPair> pairs) {
  std::vector<JointPair> sorted(pairs.begin(), pairs.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const JointPair& a, const JointPair& b) { return a.y_m < b.y_m; });
  std::vector<JointPair> places;
  double times = 0;
  for (const JointPair& pair : sorted) {
    if (places.empty() || pair.y_m - places.back().y_m > kSamePlaceM) {
      places.push_back(pair);
      times = 1;
      continue;
    }
    times += 1;
    for (std::size_t k = 0; k < pair.deg.size(); ++k) {
      places.back().deg[k] += (pair.deg[k] - places.back().deg[k]) / times;
    }
  }
  return places;
}

std::array<double, 4> weights_at(double t) {
  const double u = 1 - t;
  return {u * u * u / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * u * u + 3 * u * u * u) / 6,
          t * t * t / 6};
}

// One row a pair, then rows that smooth the spline where no pair determines it.
Eigen::MatrixXd design_of(std::span<const JointPair> pairs, double from_m, double to_m,
                          int intervals) {
  constexpr double kSmooth = 1e-4;
  const auto rows = static_cast<Eigen::Index>(pairs.size());
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(rows + intervals, intervals + 3);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const double place =
        (pairs[static_cast<std::size_t>(row)].y_m - from_m) / (to_m - from_m) * intervals;
    const int interval = std::clamp(static_cast<int>(place), 0, intervals - 1);
    const std::array<double, 4> weights = weights_at(place - interval);
    for (int i = 0; i < 4; ++i) design(row, interval + i) = weights[static_cast<std::size_t>(i)];
  }
  for (Eigen::Index i = 0; i < intervals; ++i) {
    design(rows + i, i) = -kSmooth;
    design(rows + i, i + 1) = 3 * kSmooth;
    design(rows + i, i + 2) = -3 * kSmooth;
    design(rows + i, i + 3) = kSmooth;
  }
  return design;
}

// Isotonic regression: pools neighbours that are out of order.
void make_increasing(Eigen::Ref<Eigen::VectorXd> values) {
  struct Pool {
    double mean = 0;
    Eigen::Index size = 0;
  };
  std::vector<Pool> pools;
  for (const double value : values) {
    Pool pool{value, 1};
    while (!pools.empty() && pools.back().mean > pool.mean) {
      const Pool& last = pools.back();
      const auto size = static_cast<double>(pool.size + last.size);
      pool.mean = (pool.mean * static_cast<double>(pool.size) +
                   last.mean * static_cast<double>(last.size)) /
                  size;
      pool.size += last.size;
      pools.pop_back();
    }
    pools.push_back(pool);
  }
  Eigen::Index at = 0;
  for (const Pool& pool : pools) {
    values.segment(at, pool.size).setConstant(pool.mean);
    at += pool.size;
  }
}

// 1: increasing, −1: decreasing, 0: neither, with a tolerance for noise.
int direction_of(const std::vector<JointPair>& places, std::size_t joint) {
  constexpr double kMostBack = 0.02;
  const double net = places.back().deg[joint] - places.front().deg[joint];
  double back = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double step = places[i].deg[joint] - places[i - 1].deg[joint];
    if (step * net < 0) back += std::abs(step);
  }
  if (net == 0 || back > kMostBack * std::abs(net)) return 0;
  return net > 0 ? 1 : -1;
}

double longest_gap(const std::vector<JointPair>& places) {
  double longest_m = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    longest_m = std::max(longest_m, places[i].y_m - places[i - 1].y_m);
  }
  return longest_m;
}

int intervals_for(const JointFitParams& params, std::size_t places) {
  const int fixed = static_cast<int>(places) - 3;
  if (params.intervals == 0) {
    return std::clamp(static_cast<int>(places) / 2, 1, std::min(fixed, kMostIntervals));
  }
  if (params.intervals < 1 || params.intervals > fixed) {
    refuse(std::to_string(places) + " places fix a spline of 1 to " + std::to_string(fixed) +
           " intervals, not of " + std::to_string(params.intervals));
  }
  return params.intervals;
}

}  // namespace

JointFit fit_joint_table(std::span<const JointPair> pairs, const JointFitParams& params) {
  check(pairs, params);
  const std::vector<JointPair> places = places_of(pairs);
  const double from_m = places.front().y_m;
  const double to_m = places.back().y_m;
  if (places.size() < kLeastPlaces) {
    refuse("at least 4 different places are needed, got " + std::to_string(places.size()));
  }
  if (to_m - from_m < kShortestM) refuse("the places must span at least 20 mm");

  JointFit fit;
  fit.places = places.size();
  fit.longest_gap_m = longest_gap(places);
  if (fit.longest_gap_m > (to_m - from_m) / 3 * (1 + 1e-9)) {
    refuse("there is a gap of " + std::to_string(fit.longest_gap_m) +
           " m between neighbouring places, more than a third of the line");
  }
  const int intervals = intervals_for(params, places.size());
  const Eigen::MatrixXd design = design_of(pairs, from_m, to_m, intervals);
  const auto rows = static_cast<Eigen::Index>(pairs.size());
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(design);

  fit.table.from_m = from_m;
  fit.table.to_m = to_m;
  for (std::size_t k = 0; k < places.front().deg.size(); ++k) {
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(design.rows());
    for (Eigen::Index row = 0; row < rows; ++row) {
      wanted(row) = pairs[static_cast<std::size_t>(row)].deg[k];
    }
    const int direction = direction_of(places, k);
    // Of a decreasing joint the negative increases.
    Eigen::VectorXd control = solver.solve(wanted);
    if (direction != 0) {
      control *= direction;
      make_increasing(control);
      control *= direction;
    }
    const Eigen::VectorXd off = (design * control - wanted).head(rows);
    fit.residuals.push_back({direction != 0,
                             std::sqrt(off.squaredNorm() / static_cast<double>(rows)),
                             off.cwiseAbs().maxCoeff()});

    LineJoint joint;
    joint.name = "joint " + std::to_string(k);
    joint.control_deg.assign(control.begin(), control.end());
    joint.limits = params.limits;
    const auto measured = wanted.head(rows);
    joint.limits.lowest = measured.minCoeff() - params.margin_deg;
    joint.limits.highest = measured.maxCoeff() + params.margin_deg;
    fit.table.joints.push_back(joint);
  }
  const JointTable usable(fit.table);
  return fit;
}

}  // namespace puck
