#include "common/baselines/particle_template.h"

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("the reference template has the authors' 354 positive and 207 negative pixels") {
  const ParticleTemplate reference(TemplateShape::kReference);
  CHECK(reference.positive_pixels() == 354);
  CHECK(reference.negative_pixels() == 207);
  CHECK(reference.half_side() == 15);
}

TEST_CASE("the reference template is wider than tall and cut off left and right") {
  const ParticleTemplate reference(TemplateShape::kReference);
  CHECK(reference.at(0, 0) == -2);
  CHECK(reference.at(0, -5) == -2);  // the ring reaches from 5.3 to 9.2 px up and down
  CHECK(reference.at(0, -6) == 1);
  CHECK(reference.at(0, 9) == 1);
  CHECK(reference.at(0, 10) == 0);
  CHECK(reference.at(10, 0) == -2);  // and from 10.1 to 17.5 px left and right
  CHECK(reference.at(11, 0) == 1);
  CHECK(reference.at(15, 0) == 1);
  CHECK_FALSE(reference.at(15.6, 0).has_value());
  CHECK_FALSE(reference.at(0, -15.6).has_value());
}

TEST_CASE("the reference template keeps its aspect of 1.9 for every puck") {
  ParticleTemplate reference(TemplateShape::kReference);
  reference.fit({30, 30});
  CHECK(reference.positive_pixels() == 354);
  const PuckSize size = reference.size_of_radius(15);
  CHECK(size.width == doctest::Approx(28.5));
  CHECK(size.height == doctest::Approx(15));
}

TEST_CASE("the ellipse takes the puck's aspect and shows the whole ring") {
  ParticleTemplate ellipse(TemplateShape::kEllipse);
  ellipse.fit({30, 20});
  // Semi-axes 14.25 and 9.5 px: the ring lies between the factors √0.5 and √1.5.
  CHECK(ellipse.at(10, 0) == -2);
  CHECK(ellipse.at(11, 0) == 1);
  CHECK(ellipse.at(17, 0) == 1);
  CHECK(ellipse.at(18, 0) == 0);
  CHECK(ellipse.at(0, 6) == -2);
  CHECK(ellipse.at(0, 7) == 1);
  CHECK(ellipse.at(0, 11) == 1);
  CHECK(ellipse.at(0, 12) == 0);
  // Ring and inside have the areas π·a·b and π·a·b / 2: 425 and 213 px.
  CHECK(ellipse.positive_pixels() == doctest::Approx(425.3).epsilon(0.02));
  CHECK(ellipse.negative_pixels() == doctest::Approx(212.6).epsilon(0.02));
  const PuckSize size = ellipse.size_of_radius(ParticleTemplate::radius_of_width(36));
  CHECK(size.width == doctest::Approx(36));
  CHECK(size.height == doctest::Approx(24));
}

TEST_CASE("a puck taller than wide is searched for as a circle") {
  ParticleTemplate ellipse(TemplateShape::kEllipse);
  ellipse.fit({10, 40});
  CHECK(ellipse.at(0, 17) == 1);
  CHECK(ellipse.at(17, 0) == 1);
}

}  // namespace puck
