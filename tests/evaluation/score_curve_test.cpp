#include "common/evaluation/score_curve.h"

#include <limits>

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("precision and recall are shares of the accepted and of the correct estimates") {
  ScoreCurve curve;
  curve.add(0.9, 0.5);  // right
  curve.add(0.8, 4.0);  // right, at the limit
  curve.add(0.7, 4.1);  // wrong
  curve.add(0.2, 1.0);  // right
  curve.add(0.1, 100);  // wrong
  CHECK(curve.ticks() == 5);

  const auto all = curve.at(0);
  CHECK(all.precision == doctest::Approx(0.6));
  CHECK(all.recall == 1);
  const auto half = curve.at(ScoreCurve::kSteps / 2);
  CHECK(half.threshold == 0.5);
  CHECK(half.believed == 3);
  CHECK(half.right == 2);
  CHECK(half.precision == doctest::Approx(2.0 / 3));
  CHECK(half.recall == doctest::Approx(2.0 / 3));
  CHECK(half.f1() == doctest::Approx(2.0 / 3));
  const auto none = curve.at(ScoreCurve::kSteps);
  CHECK(none.believed == 0);
  CHECK(none.precision == 1);
  CHECK(none.recall == 0);
}

TEST_CASE("a perfect score has a threshold between correct and wrong, and area 1") {
  ScoreCurve curve;
  for (int i = 0; i < 10; ++i) curve.add(0.6 + 0.01 * i, 1);
  for (int i = 0; i < 10; ++i) curve.add(0.3 + 0.01 * i, 50);
  CHECK(curve.best().threshold == doctest::Approx(0.6));
  CHECK(curve.best().f1() == 1);
  CHECK(curve.average_precision() == doctest::Approx(1));
}

TEST_CASE("an uninformative score has the area of the correct share") {
  ScoreCurve curve;
  for (int i = 0; i < 100; ++i) curve.add(0.01 * (i / 4), i % 4 == 0 ? 1 : 50);
  CHECK(curve.average_precision() == doctest::Approx(0.25).epsilon(0.01));
}

TEST_CASE("scores out of range are counted at the ends of the range") {
  ScoreCurve curve;
  curve.add(7, 1);
  curve.add(-7, 1);
  curve.add(std::numeric_limits<double>::quiet_NaN(), 1);
  CHECK(curve.at(ScoreCurve::kSteps).believed == 1);
  CHECK(curve.at(0).believed == 3);
  CHECK(ScoreCurve().best().recall == 0);
  CHECK(ScoreCurve().average_precision() == 0);
}

}  // namespace puck
