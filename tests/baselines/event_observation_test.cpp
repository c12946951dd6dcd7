#include "common/baselines/event_observation.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

// On the ring, inside it and beyond it, for a particle of scale 1 at the origin.
constexpr Pixel kOnRing{0, 7};
constexpr Pixel kInside{0, 0};
constexpr Pixel kBeyondRing{0, 12};
constexpr Pixel kOffTemplate{0, 40};

constexpr Particle kParticle{{0, 0}, 1, 1};

void push(EventWindow& window, Pixel place, int count) {
  for (int i = 0; i < count; ++i) window.push(place);
}

EventObservation observe_reference(const EventWindow& window, const Particle& particle) {
  return observe(window, particle, ParticleTemplate(TemplateShape::kReference), 0.03);
}

}  // namespace

TEST_CASE("each event on the ring counts one, and the smallest likelihood is 3 % of 354") {
  EventWindow window(500);
  CHECK(observe_reference(window, kParticle).likelihood == doctest::Approx(10.62));
  push(window, kOnRing, 10);
  CHECK(observe_reference(window, kParticle).likelihood == doctest::Approx(10.62));
  CHECK(observe_reference(window, kParticle).used_events == 0);
  push(window, kOnRing, 40);
  CHECK(observe_reference(window, kParticle).likelihood == doctest::Approx(50));
  CHECK(observe_reference(window, kParticle).used_events == 49);
  push(window, kOnRing, 400);
  CHECK(observe_reference(window, kParticle).likelihood == doctest::Approx(354));
}

TEST_CASE("a particle looks back only as far as increases its likelihood") {
  EventWindow window(500);
  push(window, kOnRing, 30);
  push(window, kInside, 20);
  push(window, kOnRing, 50);
  // The 20 inside cost 40, more than the 30 before them add.
  const EventObservation observed = observe_reference(window, kParticle);
  CHECK(observed.likelihood == doctest::Approx(50));
  CHECK(observed.used_events == 49);
}

TEST_CASE("events of zero weight are used, events outside the template are skipped") {
  EventWindow window(500);
  push(window, kBeyondRing, 5);
  push(window, kOnRing, 20);
  CHECK(observe_reference(window, kParticle).used_events == 24);
  EventWindow other(500);
  push(other, kOffTemplate, 5);
  push(other, kOnRing, 20);
  push(other, kOffTemplate, 3);
  CHECK(observe_reference(other, kParticle).used_events == 22);
  CHECK(observe_reference(other, kParticle).likelihood == doctest::Approx(20));
}

TEST_CASE("a particle of twice the size gets a quarter of the likelihood for as many events") {
  EventWindow window(500);
  push(window, {0, 14}, 200);
  const Particle large{{0, 0}, 0.5, 1};
  CHECK(observe_reference(window, large).likelihood == doctest::Approx(50));
}

}  // namespace puck
