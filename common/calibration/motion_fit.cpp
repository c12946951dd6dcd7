#include "common/calibration/motion_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include <Eigen/Dense>

#include "common/calibration/median.h"
#include "common/calibration/refuse.h"
#include "common/table/puck_motion.h"

namespace puck {
namespace {

constexpr std::size_t kFewestBounced = 12;
constexpr int kMostRounds = 60;
// A flight with this many times the usual residual of its kind is rejected.
constexpr double kFarOff = 4;
// Lower bound of the usual residual: below it, rejection is no stricter.
constexpr double kLeastUsualM = 5e-5;
constexpr double kMostError = 0.05;
constexpr double kMostDampingError = 0.1;
constexpr double kHighestDamping = 5;
constexpr double kConverged = 1e-6;

using Constants = Eigen::Vector3d;  // damping, restitution, grip
using Start = Eigen::Vector4d;      // x, y, vx, vy

MotionConstants constants_of(const Constants& values) { return {values[0], values[1], values[2]}; }

/// One flight and its present fit.
struct FittedFlight {
  const Flight* flight = nullptr;
  Start start = Start::Zero();
  int bounces = 0;
  double rms_m = 0;
  double weight = 1;
};

/// A flight's contribution to the normal equations of the constants, with its start eliminated.
struct Share {
  Eigen::Matrix3d information;
  Constants gradient;
  Eigen::Matrix4d start_information;
  Start start_gradient;
  Eigen::Matrix<double, 4, 3> coupling;
};

Start first_guess(const Flight& flight) {
  // Long enough for a velocity, short enough to contain at most a late bounce.
  const std::size_t at = std::min<std::size_t>(6, flight.size() - 1);
  const double dt_s = static_cast<double>(flight[at].t - flight[0].t) * 1e-6;
  const TablePoint& from = flight[0].position;
  const TablePoint& to = flight[at].position;
  return {from.x_m, from.y_m, (to.x_m - from.x_m) / dt_s, (to.y_m - from.y_m) / dt_s};
}

// Measured minus predicted positions, x and y in turn.
Eigen::VectorXd residuals(const Flight& flight, const PuckMotion& motion, const Start& start,
                          int& bounces) {
  Eigen::VectorXd off(2 * static_cast<Eigen::Index>(flight.size()));
  PuckTrack track{{{start[0], start[1]}, {start[2], start[3]}}, {}};
  bounces = 0;
  for (std::size_t i = 0; i < flight.size(); ++i) {
    if (i > 0) {
      const double dt_s = static_cast<double>(flight[i].t - flight[i - 1].t) * 1e-6;
      const PuckMotion::Advanced next = motion.advance(track, dt_s);
      track = next.track;
      bounces += next.bounces;
    }
    const auto row = 2 * static_cast<Eigen::Index>(i);
    off[row] = flight[i].position.x_m - track.state.position.x_m;
    off[row + 1] = flight[i].position.y_m - track.state.position.y_m;
  }
  return off;
}

PuckMotion motion_with(const TableGeometry& table, const Constants& constants) {
  return PuckMotion(table, with_constants({}, constants_of(constants)));
}

class Fitter {
 public:
  Fitter(const std::vector<Flight>& flights, const TableGeometry& table) : table_(table) {
    for (const Flight& flight : flights) flown_.push_back({&flight, first_guess(flight)});
    const PuckMotionParams usual;
    constants_ = {usual.damping_per_s, usual.rail_restitution, usual.rail_grip};
  }

  void converge() {
    for (int round = 0; round < kMostRounds; ++round) {
      if (step() < kConverged && round > 3) return;
    }
  }

  /// Weights the flights by their residuals.
  void weight_by_residual() {
    const std::array<double, 2> usual = usual_rms();
    for (FittedFlight& flown : flown_) {
      const double far = flown.rms_m / (kFarOff * usual[flown.bounces > 0 ? 1 : 0]);
      flown.weight = 1 / (1 + far * far);
    }
  }
  /// Accepts or rejects each flight by its residual.
  void reject_outliers() {
    const std::array<double, 2> usual = usual_rms();
    for (FittedFlight& flown : flown_) {
      flown.weight = flown.rms_m <= kFarOff * usual[flown.bounces > 0 ? 1 : 0] ? 1 : 0;
    }
  }

  std::size_t bounced() const {
    return static_cast<std::size_t>(std::count_if(
        flown_.begin(), flown_.end(),
        [](const FittedFlight& flown) { return flown.weight > 0 && flown.bounces > 0; }));
  }

  MotionFit result() const {
    MotionFit fit;
    fit.constants = constants_of(constants_);
    double squares = 0;
    double points = 0;
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const FittedFlight& flown : flown_) {
      if (flown.weight == 0) {
        ++fit.rejected;
        continue;
      }
      ++fit.flights;
      fit.bounces += static_cast<std::size_t>(flown.bounces);
      const auto n = static_cast<double>(flown.flight->size());
      squares += flown.rms_m * flown.rms_m * n;
      points += n;
      const Share share = share_of(flown);
      information += share.information;
      scatter += share.gradient * share.gradient.transpose();
    }
    fit.rms_m = std::sqrt(squares / points);
    const Eigen::FullPivLU<Eigen::Matrix3d> solver(information);
    if (!solver.isInvertible()) refuse("the bounces do not determine the constants");
    const Eigen::Matrix3d inverse = solver.inverse();
    const auto m = static_cast<double>(fit.flights);
    const Eigen::Matrix3d covariance = inverse * scatter * inverse * (m / (m - 3));
    fit.standard_error = constants_of(covariance.diagonal().cwiseMax(0).cwiseSqrt());
    return fit;
  }

 private:
  std::array<double, 2> usual_rms() const {
    std::array<std::vector<double>, 2> rms;
    for (const FittedFlight& flown : flown_) rms[flown.bounces > 0 ? 1 : 0].push_back(flown.rms_m);
    std::array<double, 2> usual{};
    for (std::size_t i = 0; i < rms.size(); ++i) {
      if (rms[i].empty()) continue;
      usual[i] = std::max(median(rms[i]), kLeastUsualM);
    }
    return usual;
  }

  Share share_of(const FittedFlight& flown) const {
    constexpr double kConstantStep = 1e-5;
    constexpr std::array<double, 4> kStartSteps{1e-6, 1e-6, 1e-5, 1e-5};
    const Flight& flight = *flown.flight;
    int bounces = 0;
    const PuckMotion motion = motion_with(table_, constants_);
    const Eigen::VectorXd off = residuals(flight, motion, flown.start, bounces);
    Eigen::Matrix<double, Eigen::Dynamic, 4> by_start(off.size(), 4);
    for (Eigen::Index k = 0; k < 4; ++k) {
      const double step = kStartSteps[static_cast<std::size_t>(k)];
      Start moved = flown.start;
      moved[k] += step;
      by_start.col(k) = (off - residuals(flight, motion, moved, bounces)) / step;
    }
    Eigen::Matrix<double, Eigen::Dynamic, 3> by_constant(off.size(), 3);
    for (Eigen::Index k = 0; k < 3; ++k) {
      // One-sided step towards the inside of the constants' range.
      const double step = constants_[k] > 0.5 ? -kConstantStep : kConstantStep;
      Constants moved = constants_;
      moved[k] += step;
      by_constant.col(k) =
          (off - residuals(flight, motion_with(table_, moved), flown.start, bounces)) / step;
    }
    Share share;
    share.start_information = by_start.transpose() * by_start;
    // Where a post or a goal stops the puck, positions do not determine its velocity.
    share.start_information.diagonal() *= 1 + 1e-9;
    share.start_gradient = by_start.transpose() * off;
    share.coupling = by_start.transpose() * by_constant;
    const auto solver = share.start_information.ldlt();
    share.information = by_constant.transpose() * by_constant -
                        share.coupling.transpose() * solver.solve(share.coupling);
    share.gradient = by_constant.transpose() * off -
                     share.coupling.transpose() * solver.solve(share.start_gradient);
    return share;
  }

  // One Gauss-Newton step; returns the change of the constants.
  double step() {
    Eigen::Matrix3d information = Eigen::Matrix3d::Identity() * 1e-12;
    Constants gradient = Constants::Zero();
    std::vector<Share> shares(flown_.size());
    for (std::size_t i = 0; i < flown_.size(); ++i) {
      if (flown_[i].weight == 0) continue;
      shares[i] = share_of(flown_[i]);
      information += flown_[i].weight * shares[i].information;
      gradient += flown_[i].weight * shares[i].gradient;
    }
    const Constants before = constants_;
    constexpr double kLongestStep = 0.05;
    const Constants wanted = information.ldlt().solve(gradient);
    constants_ += wanted.cwiseMax(-kLongestStep).cwiseMin(kLongestStep);
    constants_ = constants_.cwiseMax(0).cwiseMin(Constants(kHighestDamping, 1, 1));
    const Constants gone = constants_ - before;
    const PuckMotion motion = motion_with(table_, constants_);
    for (std::size_t i = 0; i < flown_.size(); ++i) {
      FittedFlight& flown = flown_[i];
      if (flown.weight == 0) continue;
      const Share& share = shares[i];
      flown.start +=
          share.start_information.ldlt().solve(share.start_gradient - share.coupling * gone);
      const Eigen::VectorXd off = residuals(*flown.flight, motion, flown.start, flown.bounces);
      flown.rms_m = std::sqrt(off.squaredNorm() / static_cast<double>(flown.flight->size()));
    }
    weigh_if_undecided();
    return gone.cwiseAbs().maxCoeff();
  }

  void weigh_if_undecided() {
    const bool is_decided = std::all_of(
        flown_.begin(), flown_.end(),
        [](const FittedFlight& flown) { return flown.weight == 0 || flown.weight == 1; });
    if (!is_decided) weight_by_residual();
  }

  const TableGeometry& table_;
  std::vector<FittedFlight> flown_;
  Constants constants_;
};

void check(const MotionFit& fit) {
  const auto require = [](double value, double error, double most, const char* name) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  "%s is %.3f +- %.3f: too few bounces, or too similar ones, to determine it to %g",
                  name, value, error, most);
    if (!(error <= most)) refuse(text.data());
  };
  const auto& [damping, restitution, grip] = fit.constants;
  const MotionConstants& error = fit.standard_error;
  require(damping, error.damping_per_s, kMostDampingError, "damping_per_s");
  require(restitution, error.rail_restitution, kMostError, "rail_restitution");
  require(grip, error.rail_grip, kMostError, "rail_grip");
  if (damping >= kHighestDamping || restitution <= 0 || grip <= 0) {
    refuse("no table has such constants: is the track on the table, in metres, and of a puck?");
  }
}

}  // namespace

MotionFit fit_motion(const std::vector<Flight>& flights, const TableGeometry& table) {
  if (flights.empty()) {
    refuse("there are no flights of 0.1 s or more in it: times in us, places within the table?");
  }
  Fitter fitter(flights, table);
  fitter.converge();
  fitter.weight_by_residual();
  fitter.converge();
  fitter.reject_outliers();
  fitter.converge();
  if (fitter.bounced() < kFewestBounced) {
    refuse("only " + std::to_string(fitter.bounced()) +
           " flights between two hits have a bounce at a rail, of " +
           std::to_string(flights.size()) + " flights: 12 or more are needed");
  }
  MotionFit fit = fitter.result();
  check(fit);
  return fit;
}

}  // namespace puck
