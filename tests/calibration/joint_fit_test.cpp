#include "common/calibration/joint_fit.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "tests/support/contains.h"

namespace puck {
namespace {

// One joint that grows, one that changes its direction.
std::vector<JointPair> pairs(double noise_deg = 0) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, 1);
  std::vector<JointPair> result;
  for (int i = 0; i <= 30; ++i) {
    const double y_m = -0.3 + 0.02 * i;
    result.push_back({y_m,
                      {20 + 60 * y_m + 40 * y_m * y_m + noise_deg * noise(random),
                       5 + 80 * y_m * y_m + noise_deg * noise(random)}});
  }
  return result;
}

std::string refusal_of_pairs(const std::vector<JointPair>& from,
                             const JointFitParams& params = {}) {
  try {
    fit_joint_table(from, params);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST_CASE("Joints are fitted along the line, and monotone joints stay monotone") {
  const JointFit fit = fit_joint_table(pairs(), {});
  CHECK(fit.places == 31);
  CHECK(fit.longest_gap_m == doctest::Approx(0.02));
  REQUIRE(fit.residuals.size() == 2);
  CHECK(fit.residuals[0].is_monotone);
  CHECK(!fit.residuals[1].is_monotone);
  for (const JointResidual& residual : fit.residuals) CHECK(residual.max_deg < 1e-3);
  const JointTable table(fit.table);
  std::array<double, 2> deg{};
  table.at(0.111, deg);
  CHECK(deg[0] == doctest::Approx(20 + 60 * 0.111 + 40 * 0.111 * 0.111));
  CHECK(deg[1] == doctest::Approx(5 + 80 * 0.111 * 0.111));
  // The measured value and the margin.
  CHECK(table.limits(1).highest == doctest::Approx(5 + 80 * 0.09 + 2));
}

TEST_CASE("Noise is reported as residuals, and a monotone joint stays monotone") {
  JointFitParams params;
  params.intervals = 12;
  const JointFit fit = fit_joint_table(pairs(0.1), params);
  CHECK(fit.residuals[0].is_monotone);
  CHECK(fit.residuals[0].rms_deg == doctest::Approx(0.07).epsilon(0.4));
  CHECK(JointTable(fit.table).is_monotone(0));

  // A step, at which a spline would overshoot the measured values.
  std::vector<JointPair> step;
  for (int i = 0; i <= 20; ++i) {
    step.push_back({0.02 * i, {i + (i > 10 ? 40.0 : 0.0), 2.0 * i}});
  }
  const JointFit stepped = fit_joint_table(step, params);
  CHECK(JointTable(stepped.table).is_monotone(0));
  CHECK(stepped.residuals[0].max_deg > 1);
}

TEST_CASE("Repeated measurements at a place are averaged, in any order") {
  std::vector<JointPair> twice = pairs();
  for (const JointPair& pair : pairs()) twice.push_back(pair);
  twice.back().deg[1] += 1;
  const JointFit fit = fit_joint_table(twice, {});
  CHECK(fit.places == 31);
  CHECK(fit.residuals[1].max_deg == doctest::Approx(0.5).epsilon(0.2));
}

TEST_CASE("Pairs that determine no table are refused with the reason") {
  std::vector<JointPair> few = pairs();
  few.resize(3);
  CHECK(contains(refusal_of_pairs(few), "at least 4 different places"));
  CHECK(contains(refusal_of_pairs({}), "no pairs"));
  CHECK(contains(refusal_of_pairs({4, JointPair{0.1, {1}}}), "at least 4 different places"));
  std::vector<JointPair> near = pairs();
  for (JointPair& pair : near) pair.y_m *= 0.03;
  CHECK(contains(refusal_of_pairs(near), "20 mm"));
  std::vector<JointPair> gap = pairs();
  gap.erase(gap.begin() + 5, gap.begin() + 17);
  CHECK(contains(refusal_of_pairs(gap), "a gap of 0.26"));
  std::vector<JointPair> ragged = pairs();
  ragged[4].deg.pop_back();
  CHECK(contains(refusal_of_pairs(ragged), "the same joints"));
  std::vector<JointPair> nan = pairs();
  nan[4].deg[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK(contains(refusal_of_pairs(nan), "not finite"));
  std::vector<JointPair> still = pairs();
  for (JointPair& pair : still) pair.deg[0] = 3;
  CHECK(contains(refusal_of_pairs(still), "no joint grows or falls"));
  JointFitParams many;
  many.intervals = 29;
  CHECK(contains(refusal_of_pairs(pairs(), many), "1 to 28 intervals"));
}

}  // namespace
}  // namespace puck
