#include "common/table/head_track.h"

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include <doctest/doctest.h>

namespace puck {
namespace {

// 2 degrees at 1 Hz.
HeadPose swaying(Timestamp t) {
  const double w = 2 * 3.14159265358979;
  const double angle = w * static_cast<double>(t.us) * 1e-6;
  return {2 * std::sin(angle),     std::cos(angle),      0.5,
          2 * w * std::cos(angle), -w * std::sin(angle), 0};
}

HeadTrack swaying_head(std::int64_t period_us, std::int64_t until_us) {
  HeadTrack head;
  for (Timestamp t; t.us <= until_us; t = t + period_us) head.add(t, swaying(t));
  return head;
}

TEST_CASE("Between two poses the head is interpolated by angles and speeds") {
  const HeadTrack head = swaying_head(10'000, 100'000);
  for (const std::int64_t us : {20'000, 23'000, 55'500, 99'999, 100'000}) {
    CAPTURE(us);
    const std::optional<HeadPose> pose = head.at({us});
    REQUIRE(pose);
    CHECK(std::abs(pose->yaw_deg - swaying({us}).yaw_deg) < 1e-6);
    CHECK(std::abs(pose->pitch_deg - swaying({us}).pitch_deg) < 1e-6);
    CHECK(pose->roll_deg == doctest::Approx(0.5));
    CHECK(std::abs(pose->yaw_deg_s - swaying({us}).yaw_deg_s) < 1e-3);
  }
}

TEST_CASE("Beyond the newest pose the head is extrapolated by its speeds, for a limited time") {
  const HeadTrack head = swaying_head(10'000, 100'000);
  const HeadPose newest = swaying({100'000});
  REQUIRE(head.at({110'000}));
  CHECK(head.at({110'000})->yaw_deg == doctest::Approx(newest.yaw_deg + 0.01 * newest.yaw_deg_s));
  CHECK_FALSE(head.at({110'001}));
}

TEST_CASE("Before the oldest pose, and in a long gap, the pose is unknown") {
  HeadTrack head;
  CHECK_FALSE(head.at({0}));
  head.add({1'000'000}, {});
  head.add({1'100'001}, {});
  CHECK_FALSE(head.at({999'999}));
  CHECK_FALSE(head.at({1'050'000}));
  CHECK(head.at({1'000'000 + 100'001}));
  head.add({1'150'000}, {});
  CHECK(head.at({1'120'000}));
}

TEST_CASE("Frequent poses do not displace those of 100 ms ago") {
  const HeadTrack head = swaying_head(50, 300'000);
  REQUIRE(head.at({201'000}));
  CHECK(std::abs(head.at({201'000})->yaw_deg - swaying({201'000}).yaw_deg) < 1e-6);
  CHECK(head.at({299'990}));
}

TEST_CASE("Late and impossible poses are dropped; when time restarts so does the track") {
  HeadTrack head;
  head.add({2'000'000}, {1, 0, 0, 0, 0, 0});
  head.add({1'990'000}, {5, 0, 0, 0, 0, 0});
  head.add({2'001'000}, {std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 0, 0});
  CHECK(head.at({2'005'000})->yaw_deg == 1);
  head.add({1000}, {3, 0, 0, 0, 0, 0});
  CHECK(head.at({1500})->yaw_deg == 3);
  CHECK_FALSE(head.at({2'000'000}));
  head.forget();
  CHECK(head.is_empty());
}

TEST_CASE("Head parameters out of range are refused by name") {
  CHECK_THROWS_WITH_AS(HeadTrack({-1, 1000}),
                       "head.max_ahead_ms must be between 0 and 100, got -0.001000",
                       std::invalid_argument);
}

}  // namespace
}  // namespace puck
