#include "common/baselines/particle_set.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "tests/baselines/refusal.h"
#include "tests/baselines/ring_scene.h"

namespace puck {
namespace {

using test::kSensor;

double sum_of_weights(const ParticleSet& set) {
  double sum = 0;
  for (const Particle& particle : set.particles()) sum += particle.weight;
  return sum;
}

// Nearly all weight on particle `index`.
std::vector<double> likelihoods_for(std::size_t index, std::size_t count) {
  std::vector<double> likelihoods(count, 1e-30);
  likelihoods[index] = 1;
  return likelihoods;
}

}  // namespace

TEST_CASE("the random numbers are those of the C++ standard's definition") {
  UniformRandom random(5489);
  double value = 0;
  for (int i = 0; i < 10'000; ++i) value = random.next();
  CHECK(value == static_cast<double>(9981545732273789042u >> 11) / 9007199254740992.0);
}

TEST_CASE("all particles begin at the seed with the same weight") {
  ParticleSet set(kSensor, {});
  set.seed({300, 190}, 20);
  REQUIRE(set.particles().size() == 100);
  for (const Particle& particle : set.particles()) {
    CHECK(particle.position == Pixel{300, 190});
    CHECK(particle.scale == doctest::Approx(0.75));
    CHECK(particle.weight == doctest::Approx(0.01));
  }
  CHECK(set.mean_radius_px() == doctest::Approx(20));
  set.seed({300, 190}, 1000);
  CHECK(set.mean_radius_px() == doctest::Approx(25.5));
}

TEST_CASE("weights are multiplied by the likelihoods and sum up to 1") {
  ParticleSetParams params;
  params.particles = 2;
  ParticleSet set(kSensor, params);
  set.seed({300, 190}, 20);
  set.weigh(std::vector<double>{3, 1});
  CHECK(set.particles()[0].weight == doctest::Approx(0.75));
  set.weigh(std::vector<double>{1, 3});
  CHECK(set.particles()[0].weight == doctest::Approx(0.5));
  CHECK(sum_of_weights(set) == doctest::Approx(1));
}

TEST_CASE("resampling keeps the number of particles and draws those that carry the weight") {
  ParticleSet set(kSensor, {});
  set.seed({300, 190}, 20);
  set.predict();
  const Particle heavy = set.particles()[37];
  set.weigh(likelihoods_for(37, 100));
  CHECK(set.mean_position().x == doctest::Approx(heavy.position.x));
  set.resample();
  REQUIRE(set.particles().size() == 100);
  for (const Particle& particle : set.particles()) CHECK(particle.position == heavy.position);
}

TEST_CASE("particles are drawn in proportion to their weights") {
  ParticleSetParams params;
  params.particles = 10'000;
  ParticleSet set(kSensor, params);
  set.seed({300, 190}, 20);
  set.predict();
  // The first half weighs three times as much as the second.
  std::vector<double> likelihoods(10'000, 1);
  for (std::size_t i = 0; i < 5'000; ++i) likelihoods[i] = 3;
  set.weigh(likelihoods);
  const double heavy = set.particles().front().weight;
  set.resample();
  int heavy_drawn = 0;
  for (const Particle& particle : set.particles()) heavy_drawn += particle.weight == heavy;
  // Standard deviation 43.
  CHECK(heavy_drawn > 7'300);
  CHECK(heavy_drawn < 7'700);
}

TEST_CASE("adaptive resampling leaves particles of equal weight alone") {
  ParticleSetParams params;
  params.adaptive_resampling = true;
  ParticleSet set(kSensor, params);
  set.seed({300, 190}, 20);
  set.predict();
  const Particle first = set.particles()[0];
  const Particle last = set.particles()[99];
  set.resample();
  CHECK(set.particles()[0].position == first.position);
  CHECK(set.particles()[99].position == last.position);
  set.weigh(likelihoods_for(99, 100));
  set.resample();
  CHECK(set.particles()[0].position == last.position);
}

TEST_CASE("a prediction moves particles by at most 3 px and a tenth of the scale, to both sides") {
  ParticleSet set(kSensor, {});
  set.seed({300, 190}, 15);
  set.predict();
  double left = 0;
  double right = 0;
  for (const Particle& particle : set.particles()) {
    const double dx = particle.position.x - 300;
    left = std::min(left, dx);
    right = std::max(right, dx);
    CHECK(std::abs(particle.position.y - 190) <= 3);
    CHECK(std::abs(particle.scale - 1) <= 0.1);
  }
  CHECK(left >= -3);
  CHECK(left < -2);
  CHECK(right <= 3);
  CHECK(right > 2);
}

TEST_CASE("predictions leave neither the image nor the limits of the radius") {
  ParticleSet set(kSensor, {});
  set.seed({639, 0}, 6);
  bool radius_changed = false;
  for (int i = 0; i < 300; ++i) {
    set.predict();
    for (const Particle& particle : set.particles()) {
      REQUIRE(particle.position.x >= 0);
      REQUIRE(particle.position.x <= 639);
      REQUIRE(particle.position.y >= 0);
      REQUIRE(particle.position.y <= 479);
      REQUIRE(particle.scale >= doctest::Approx(15 / 25.5));
      REQUIRE(particle.scale <= doctest::Approx(2.5));
      radius_changed = radius_changed || particle.scale < 1;
    }
  }
  CHECK(radius_changed);
}

TEST_CASE("a particle set refuses parameters out of range and names the key") {
  const auto refusal = [](auto change) {
    ParticleSetParams params;
    change(params);
    return test::refusal([&] { ParticleSet(kSensor, params); });
  };
  CHECK(refusal([](auto&) {}).empty());
  CHECK(refusal([](auto& p) { p.particles = 0; }) ==
        "particle_filter.particles must be at least 1, got 0");
  CHECK(refusal([](auto& p) {
          p.position_spread_px = -1;
        }).starts_with("particle_filter.position_spread_px must"));
  CHECK(refusal([](auto& p) {
          p.scale_spread = -1;
        }).starts_with("particle_filter.scale_spread must"));
  CHECK(refusal([](auto& p) {
          p.smallest_radius_px = 0;
        }).starts_with("particle_filter.smallest_radius_px must"));
  CHECK(refusal([](auto& p) { p.largest_radius_px = 5; }) ==
        "particle_filter.largest_radius_px must be at least 6.000000, got 5.000000");
}

}  // namespace puck
