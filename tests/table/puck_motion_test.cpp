#include "common/table/puck_motion.h"

#include <cmath>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/table/test_table.h"

namespace puck {
namespace {

TEST_CASE("Without damping the puck glides at constant velocity") {
  const PuckMotion motion(kTable, kIdeal);
  const PuckMotion::Advanced end = motion.advance(track_at(0.5, 0, 1, 0.2), 0.5);
  CHECK(end.track.state.position.x_m == doctest::Approx(1.0));
  CHECK(end.track.state.position.y_m == doctest::Approx(0.1));
  CHECK(end.bounces == 0);
}

TEST_CASE("Damping slows the puck exponentially, to a stop after velocity over damping") {
  PuckMotionParams params = kIdeal;
  params.damping_per_s = 2;
  const PuckMotion motion(kTable, params);
  const PuckTrack half = motion.advance(track_at(0.5, 0, 1, 0), std::log(2.0) / 2).track;
  CHECK(half.state.velocity.x_m_s == doctest::Approx(0.5));
  CHECK(half.state.position.x_m == doctest::Approx(0.75));
  const PuckTrack end = motion.advance(track_at(0.5, 0, 1, 0), 100).track;
  CHECK(end.state.position.x_m == doctest::Approx(1.0));
}

TEST_CASE("The puck's rim bounces at a side rail with restitution across and grip along") {
  PuckMotionParams params = kIdeal;
  params.rail_restitution = 0.5;
  params.rail_grip = 0.8;
  const PuckMotion motion(kTable, params);
  // Reaches y = 0.4 after 0.4 s at x = 0.9, then goes on with (0.8, -0.5) for 0.2 s.
  const PuckMotion::Advanced end = motion.advance(track_at(0.5, 0, 1, 1), 0.6);
  CHECK(end.bounces == 1);
  CHECK(end.track.state.position.x_m == doctest::Approx(0.9 + 0.16));
  CHECK(end.track.state.position.y_m == doctest::Approx(0.4 - 0.1));
  CHECK(end.track.state.velocity.x_m_s == doctest::Approx(0.8));
  CHECK(end.track.state.velocity.y_m_s == doctest::Approx(-0.5));
}

TEST_CASE("A step includes several bounces") {
  const PuckMotion motion(kTable, kIdeal);
  // Across 0.8 m between the rails at 4 m/s: from the middle, bounces at 0.1, 0.3, 0.5, 0.7 s.
  const PuckMotion::Advanced end = motion.advance(track_at(1, 0, 0.1, 4), 0.8);
  CHECK(end.bounces == 4);
  CHECK(end.track.state.position.y_m == doctest::Approx(0).epsilon(1e-9));
  CHECK(end.track.state.velocity.y_m_s == doctest::Approx(4));
}

TEST_CASE("A step in many pieces ends at the same place as one whole step") {
  const PuckMotion motion(kTable);
  const PuckTrack start = track_at(1.2, 0.1, 3, 5);
  const PuckTrack whole = motion.advance(start, 0.5).track;
  PuckTrack pieces = start;
  for (int i = 0; i < 500; ++i) pieces = motion.advance(pieces, 0.001).track;
  CHECK(pieces.state.position.x_m == doctest::Approx(whole.state.position.x_m));
  CHECK(pieces.state.position.y_m == doctest::Approx(whole.state.position.y_m));
  // The noise is integrated as if the damping within one step were small.
  CHECK(pieces.covariance(1, 1) == doctest::Approx(whole.covariance(1, 1)).epsilon(0.01));
}

TEST_CASE("In a corner the puck bounces at both rails and returns the same way") {
  const PuckMotion motion(kTable, kIdeal);
  const PuckMotion::Advanced end = motion.advance(track_at(1.8, 0.3, 1, 1), 0.2);
  CHECK(end.bounces == 2);
  CHECK(end.track.state.position.x_m == doctest::Approx(1.8));
  CHECK(end.track.state.position.y_m == doctest::Approx(0.3));
  CHECK(end.track.state.velocity.x_m_s == doctest::Approx(-1));
  CHECK(end.track.state.velocity.y_m_s == doctest::Approx(-1));
}

TEST_CASE("The end rail returns the puck beside the goal and lets it in between the posts") {
  const PuckMotion motion(kTable, kIdeal);
  const PuckMotion::Advanced beside = motion.advance(track_at(0.5, 0.21, -1, 0), 0.6);
  CHECK_FALSE(beside.in_goal);
  CHECK(beside.track.state.velocity.x_m_s == doctest::Approx(1));
  const PuckMotion::Advanced inside = motion.advance(track_at(0.5, 0.09, -1, 0), 0.7);
  CHECK(inside.in_goal);
  CHECK(inside.bounces == 0);
  CHECK(inside.track.state.position.x_m == doctest::Approx(-0.1));
  CHECK(inside.track.state.velocity.x_m_s == 0);
}

TEST_CASE("A goal post, a point, deflects the puck's rim along the line through its centre") {
  const PuckMotion motion(kTable, kIdeal);
  // The post lies at (0, 0.2), the puck's centre 0.06 beside it: contact at x = 0.08, where the
  // normal is (0.8, -0.6). (-1, 0) is mirrored at it to (0.28, -0.96).
  const PuckMotion::Leg robots = motion.next_leg(track_at(0.5, 0.14, -1, 0), 1);
  CHECK(robots.end == PuckMotion::LegEnd::kBounce);
  CHECK(robots.duration_s == doctest::Approx(0.42));
  CHECK(robots.track.state.velocity.x_m_s == doctest::Approx(0.28));
  CHECK(robots.track.state.velocity.y_m_s == doctest::Approx(-0.96));
  const PuckMotion::Leg opponents = motion.next_leg(track_at(1.5, -0.14, 1, 0), 1);
  CHECK(opponents.duration_s == doctest::Approx(0.42));
  CHECK(opponents.track.state.velocity.x_m_s == doctest::Approx(-0.28));
  CHECK(opponents.track.state.velocity.y_m_s == doctest::Approx(0.96));
  // With the contact beyond the post's middle it comes back out, else it goes in by the other post.
  CHECK_FALSE(motion.advance(track_at(0.5, 0.14, -1, 0), 0.6).in_goal);
}

TEST_CASE("The place of contact with a post determines the direction, so the spread grows there") {
  const PuckMotion motion(kTable, kIdeal);
  PuckTrack start = track_at(0.5, 0.14, -1, 0);
  start.covariance = diagonal(1e-6, 1e-6, 0, 0);
  const Matrix4 p = motion.next_leg(start, 1).track.covariance;
  // By a tenth of the radius in 100: 2 * 1 m/s * 0.001 / 0.1.
  CHECK(p(2, 2) == doctest::Approx(4e-4));
  CHECK(p(3, 3) == doctest::Approx(4e-4));
}

TEST_CASE("A measured place beyond a rail is moved back to the table") {
  const PuckMotion motion(kTable, kIdeal);
  const PuckTrack outward = motion.advance(track_at(1, 0.45, 0, 1), 0.1).track;
  CHECK(outward.state.position.y_m == doctest::Approx(0.3));
  const PuckTrack inward = motion.advance(track_at(1, 0.45, 0, -1), 0.1).track;
  CHECK(inward.state.position.y_m == doctest::Approx(0.35));
}

TEST_CASE("The covariance grows with gliding, since the place depends on the velocity") {
  const PuckMotion motion(kTable, kIdeal);
  PuckTrack start = track_at(1, 0, 0, 0.1);
  start.covariance = diagonal(0.01, 0.04, 0.25, 1);
  const Matrix4 p = motion.advance(start, 0.5).track.covariance;
  CHECK(p(0, 0) == doctest::Approx(0.01 + 0.25 * 0.25));
  CHECK(p(0, 2) == doctest::Approx(0.5 * 0.25));
  CHECK(p(1, 1) == doctest::Approx(0.04 + 0.25 * 1));
}

TEST_CASE("A bounce reflects the covariance and adds the bounce's spread to the velocity's") {
  PuckMotionParams params = kIdeal;
  params.rail_restitution = 0.5;
  params.bounce_spread = 0.1;
  const PuckMotion motion(kTable, params);
  PuckTrack start = track_at(1, 0.4, 0, 2);
  start.covariance = diagonal(0.01, 0.04, 0.25, 1);
  start.covariance(0, 1) = start.covariance(1, 0) = 0.01;
  const PuckMotion::Leg leg = motion.next_leg(start, 1);
  CHECK(leg.end == PuckMotion::LegEnd::kBounce);
  CHECK(leg.track.covariance(1, 1) == doctest::Approx(0.25 * 0.04));
  CHECK(leg.track.covariance(0, 1) == doctest::Approx(-0.5 * 0.01));
  CHECK(leg.track.covariance(3, 3) == doctest::Approx(0.25 * 1 + 0.04));
}

TEST_CASE("Values out of range are refused by name") {
  PuckMotionParams params;
  params.rail_restitution = 1.5;
  CHECK_THROWS_WITH_AS(PuckMotion(kTable, params),
                       "motion.rail_restitution must be between 0 and 1, got 1.5",
                       std::invalid_argument);
  TableGeometry table = kTable;
  table.width_m = 0;
  CHECK_THROWS_AS(PuckMotion{table}, std::invalid_argument);
}

}  // namespace
}  // namespace puck
