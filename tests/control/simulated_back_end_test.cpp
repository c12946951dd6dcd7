#include "common/control/simulated_back_end.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <doctest/doctest.h>

#include "common/motion/simulated_joints.h"

namespace puck {
namespace {

// All joints at rest except the first, which gets set-points.
class Plant {
 public:
  explicit Plant(const SimulatedBackEndParams& params)
      : start_(middle()), back_end(params, table_, start_) {}

  double first_at(std::int64_t us) { return back_end.reading(us)->position[0] - start_[0]; }
  void send_first(double deg, std::int64_t us) {
    JointAngles to = start_;
    to[0] += deg;
    back_end.command(to, us);
  }

 private:
  JointAngles middle() const {
    std::array<double, 7> deg{};
    table_.at(0, deg);
    return JointAngles(deg);
  }

  JointTable table_{simulated_joints()};
  JointAngles start_;

 public:
  SimulatedBackEnd back_end;
};

TEST_CASE("A joint follows as a critically damped second-order drive, after its delay") {
  Plant plant({.frequency_hz = 10, .delay_ms = 5});
  CHECK(plant.first_at(1'000) == 0);
  plant.send_first(1, 2'000);
  CHECK(plant.first_at(7'000) == 0);
  const double omega = 2 * std::numbers::pi * 10;
  for (const int ms : {3, 10, 30, 100}) {
    const double t = omega * 1e-3 * ms;
    CHECK(plant.first_at(7'000 + 1'000 * ms) == doctest::Approx(1 - (1 + t) * std::exp(-t)));
  }
}

TEST_CASE("The division of time into calls does not change the result") {
  Plant often({});
  Plant seldom({});
  often.first_at(0);
  seldom.first_at(0);
  often.send_first(2, 100);
  seldom.send_first(2, 100);
  for (std::int64_t us = 100; us <= 50'100; us += 70) often.first_at(us);
  CHECK(often.first_at(50'100) == doctest::Approx(seldom.first_at(50'100)).epsilon(1e-6));
}

TEST_CASE("A joint obeys its speed limit, and play delays it on a reversal") {
  Plant fast({.frequency_hz = 100, .delay_ms = 0});
  fast.first_at(0);
  fast.send_first(15, 0);
  const double limit_deg_s = JointTable(simulated_joints()).limits(0).velocity;
  double before = 0;
  for (int ms = 1; ms < 200; ++ms) {
    const double now = fast.first_at(1'000 * ms);
    REQUIRE((now - before) / 1e-3 <= limit_deg_s * (1 + 1e-9));
    before = now;
  }
  CHECK(before == doctest::Approx(15));

  Plant loose({.frequency_hz = 100, .delay_ms = 0, .backlash_deg = 0.5});
  loose.first_at(0);
  loose.send_first(5, 0);
  CHECK(loose.first_at(1'000'000) == doctest::Approx(4.75));
  loose.send_first(4.6, 1'000'000);
  CHECK(loose.first_at(2'000'000) == doctest::Approx(4.75));
  loose.send_first(3, 2'000'000);
  CHECK(loose.first_at(3'000'000) == doctest::Approx(3.25));
}

TEST_CASE("A set-point that is not finite is a fault and causes no motion") {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 1e9}) {
    Plant plant({});
    CHECK(plant.back_end.fault(0).empty());
    plant.send_first(bad, 0);
    CHECK(!plant.back_end.fault(0).empty());
    CHECK(plant.first_at(1'000'000) == 0);
  }
}

TEST_CASE("Impossible drives are refused by their key") {
  CHECK_THROWS_WITH_AS(Plant({.frequency_hz = 0}),
                       "arm.simulated_frequency_hz must be from 0.100000 to 1000.000000, got "
                       "0.000000",
                       std::invalid_argument);
  CHECK_THROWS_AS(Plant({.delay_ms = -1}), std::invalid_argument);
  CHECK_THROWS_AS(Plant({.backlash_deg = std::numeric_limits<double>::quiet_NaN()}),
                  std::invalid_argument);
}

}  // namespace
}  // namespace puck
