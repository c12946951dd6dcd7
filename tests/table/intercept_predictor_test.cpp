#include "common/table/intercept_predictor.h"

#include <optional>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

#include "tests/table/test_table.h"

namespace puck {
namespace {

TEST_CASE("A straight shot crosses at the expected place and time") {
  const InterceptPredictor predictor{PuckMotion(kTable, kIdeal)};
  const std::optional<Intercept> crossing = predictor.predict(track_at(1.3, 0, -2, 0.4));
  REQUIRE(crossing);
  CHECK(crossing->x_m == doctest::Approx(0.3));
  CHECK(crossing->in_s == doctest::Approx(0.5));
  CHECK(crossing->y_m == doctest::Approx(0.2));
  CHECK(crossing->speed_m_s == doctest::Approx(2.0396).epsilon(1e-4));
  CHECK(crossing->bounces == 0);
}

TEST_CASE("A bank shot crosses after its bounce, on the other side") {
  const InterceptPredictor predictor{PuckMotion(kTable, kIdeal)};
  // Meets y = 0.4 after 0.2 s, then comes down by 0.6 within the remaining 0.3 s.
  const std::optional<Intercept> crossing = predictor.predict(track_at(1.3, 0, -2, 2));
  REQUIRE(crossing);
  CHECK(crossing->in_s == doctest::Approx(0.5));
  CHECK(crossing->y_m == doctest::Approx(-0.2));
  CHECK(crossing->bounces == 1);
}

TEST_CASE("A puck that moves away is not predicted: the opponent's mallet will be in its way") {
  const InterceptPredictor predictor{PuckMotion(kTable, kIdeal)};
  CHECK_FALSE(predictor.predict(track_at(1.1, 0.3, 2, 0)));
  CHECK_FALSE(predictor.predict(track_at(0.5, 0.3, 2, 0)));
}

TEST_CASE("A slow puck in the opponent's half is not predicted; one that leaves it soon is") {
  const InterceptPredictor predictor{PuckMotion(kTable, kIdeal)};
  // 0.6 m to the middle of the table.
  CHECK_FALSE(predictor.predict(track_at(1.6, 0, -1.19, 0)));
  CHECK(predictor.predict(track_at(1.6, 0, -1.21, 0)));
  // In the robot's half a slow puck counts, too.
  CHECK(predictor.predict(track_at(0.99, 0, -0.4, 0)));
}

TEST_CASE("No crossing: the puck rests, stops short, is too slow, too late, or past the line") {
  PuckMotionParams damped = kIdeal;
  damped.damping_per_s = 1;
  const InterceptPredictor predictor{PuckMotion(kTable, damped)};
  CHECK_FALSE(predictor.predict(track_at(1.3, 0, 0, 0)));
  CHECK_FALSE(predictor.predict(track_at(1.3, 0, -0.99, 0)));
  CHECK_FALSE(predictor.predict(track_at(1.3, 0, -1.04, 0)));
  CHECK(predictor.predict(track_at(1.3, 0, -1.2, 0)));
  CHECK_FALSE(predictor.predict(track_at(0.29, 0, -2, 0)));
  InterceptParams soon;
  soon.horizon_s = 0.4;
  CHECK_FALSE(
      InterceptPredictor(PuckMotion(kTable, kIdeal), soon).predict(track_at(1.3, 0, -2, 0)));
}

TEST_CASE("Paths with more bounces than allowed are not predicted") {
  InterceptParams direct;
  direct.max_bounces = 0;
  CHECK_FALSE(
      InterceptPredictor(PuckMotion(kTable, kIdeal), direct).predict(track_at(1.3, 0, -2, 2)));
}

TEST_CASE("The spread of place and time follows from the covariance") {
  const InterceptPredictor predictor{PuckMotion(kTable, kIdeal)};
  PuckTrack track = track_at(1.3, 0, -2, 0);
  track.covariance = diagonal(0.0001, 0.0004, 0, 0.01);
  const std::optional<Intercept> straight = predictor.predict(track);
  REQUIRE(straight);
  // y: 0.02 now and 0.1 m/s for 0.5 s; t: 0.01 m at 2 m/s.
  CHECK(straight->sigma_y_m == doctest::Approx(0.053852).epsilon(1e-4));
  CHECK(straight->sigma_t_s == doctest::Approx(0.005));
  // Along a slanted path an error in x moves the crossing in y: slope 1, 0.01 m.
  track = track_at(1.3, 0.4, -0.8, -0.8);
  track.covariance = diagonal(0.0001, 0, 0, 0);
  CHECK(predictor.predict(track)->sigma_y_m == doctest::Approx(0.01));
}

TEST_CASE("The predicted path starts at the puck, keeps its step and ends in the goal") {
  const InterceptPredictor predictor{PuckMotion(kTable, kIdeal)};
  std::vector<PathPoint> path;
  predictor.predict_path(track_at(0.85, 0, -2, 0), std::nullopt, 1.0, 0.1, path);
  REQUIRE(path.size() == 5);
  CHECK(path[0].position.x_m == doctest::Approx(0.85));
  CHECK(path[4].t_s == doctest::Approx(0.4));
  CHECK(path[4].position.x_m == doctest::Approx(0.05));
}

TEST_CASE("The predicted path ends at the robot's mallet and in the opponent's reach") {
  const InterceptPredictor predictor{PuckMotion(kTable, kIdeal)};
  std::vector<PathPoint> path;
  // The discs touch at 0.15 from centre to centre: x = 0.3, after 0.3 s.
  predictor.predict_path(track_at(0.91, 0.05, -2, 0), TablePoint{0.15, 0.05}, 1.0, 0.1, path);
  REQUIRE(path.size() == 5);
  CHECK(path.back().position.x_m == doctest::Approx(0.11));
  predictor.predict_path(track_at(0.91, 0.3, -2, 0), TablePoint{0.15, 0.05}, 1.0, 0.1, path);
  CHECK(path.size() == 11);
  // In the opponent's half from 0.1 s on.
  predictor.predict_path(track_at(0.95, 0.3, 1, 0), std::nullopt, 2.0, 0.1, path);
  CHECK(path.back().t_s == doctest::Approx(0.6));
}

TEST_CASE("Intercept parameters out of range are refused by name") {
  InterceptParams params;
  params.horizon_s = 0;
  CHECK_THROWS_AS(InterceptPredictor(PuckMotion(kTable), params), std::invalid_argument);
}

}  // namespace
}  // namespace puck
