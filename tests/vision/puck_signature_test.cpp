#include "common/vision/puck_signature.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

PuckSignature::Sample passing(int pixels, int events_each, bool on_where_it_advances) {
  PuckSignature::Sample sample;
  for (int i = 0; i < pixels; ++i) {
    const double normal_speed = i % 2 == 0 ? 500 : -500;
    for (int n = 0; n < events_each; ++n) {
      sample.count((normal_speed > 0) == on_where_it_advances, normal_speed, n == 0);
      sample.events += 1;
    }
  }
  sample.swept_px2 = pixels;
  return sample;
}

TEST_CASE("Nothing is claimed of a puck that has hardly been seen") {
  PuckSignature signature;
  signature.learn(passing(4, 1, false), 1000);
  CHECK(signature.contrast_sign() == 0);
  CHECK(signature.density() == 0);
  CHECK_FALSE(signature.is_faint());
}

TEST_CASE("A dark puck is told from a bright one, and a faint one from either") {
  PuckSignature dark;
  dark.learn(passing(3'000, 5, false), 1000);
  CHECK(dark.contrast_sign() == doctest::Approx(-1));
  CHECK(dark.multiplicity() == doctest::Approx(5));
  CHECK(dark.density() == doctest::Approx(5));
  CHECK_FALSE(dark.is_faint());

  PuckSignature faint;
  faint.learn(passing(300, 1, true), 1000);
  CHECK(faint.contrast_sign() == doctest::Approx(1));
  CHECK(faint.is_faint());
}

TEST_CASE("What the density was is known after a rest in which all else is forgotten") {
  PuckSignature signature;
  CHECK(signature.last_density() == 0);
  signature.learn(passing(3'000, 5, false), 1'000);
  for (int i = 0; i < 10; ++i) signature.learn({}, 500'000);
  REQUIRE(signature.density() == 0);
  CHECK(signature.last_density() == doctest::Approx(5));
}

TEST_CASE("A puck of two events a pixel may be faint, one of three is not") {
  PuckSignature unknown;
  CHECK_FALSE(unknown.may_be_faint());
  PuckSignature doubtful;
  doubtful.learn(passing(300, 2, true), 1000);
  CHECK_FALSE(doubtful.is_faint());
  CHECK(doubtful.may_be_faint());
  PuckSignature dark;
  dark.learn(passing(300, 3, false), 1000);
  CHECK_FALSE(dark.may_be_faint());
}

// Of a puck of so many events well inside its contour for each one on it, area for area.
PuckSignature::Sample facing(double inside_for_each) {
  PuckSignature::Sample sample;
  sample.ring_per_px2 = 1;
  sample.inside_per_px2 = inside_for_each;
  return sample;
}

TEST_CASE("A face is plain once it has been seen long enough, and stays so through a rest") {
  PuckSignature plain;
  CHECK_FALSE(plain.has_plain_face());
  plain.learn(facing(0.02), 1'000);
  CHECK_FALSE(plain.has_plain_face());
  for (int i = 0; i < 10; ++i) plain.learn(facing(0.02), 1'000);
  CHECK(plain.has_plain_face());
  for (int i = 0; i < 10; ++i) plain.learn({}, 500'000);
  CHECK(plain.has_plain_face());

  PuckSignature printed;
  for (int i = 0; i < 100; ++i) printed.learn(facing(0.4), 1'000);
  CHECK_FALSE(printed.has_plain_face());
}

TEST_CASE("Whether a face is plain is told by the latest events") {
  PuckSignature signature;
  for (int i = 0; i < 1'000; ++i) signature.learn(facing(0), 1'000);
  REQUIRE(signature.has_plain_face());
  for (int i = 0; i < 8; ++i) signature.learn(facing(0.4), 1'000);
  CHECK_FALSE(signature.has_plain_face());
}

TEST_CASE("That the puck has contrast is remembered when its looks are forgotten, if confirmed") {
  PuckSignature signature;
  CHECK_FALSE(signature.remembers_contrast());
  signature.learn(passing(300, 5, false), 1'000);
  CHECK(signature.remembers_contrast());
  signature.confirm(300'000);
  PuckSignature hardly_confirmed = signature;
  hardly_confirmed.forget();
  CHECK_FALSE(hardly_confirmed.remembers_contrast());
  signature.confirm(1'000);
  signature.forget();
  REQUIRE_FALSE(signature.had_contrast());
  CHECK(signature.remembers_contrast());
  // What is seen now counts more.
  signature.learn(passing(300, 1, false), 1'000);
  CHECK_FALSE(signature.remembers_contrast());
}

TEST_CASE("That a puck was not faint is remembered while it is slow, until it proves to be") {
  PuckSignature signature;
  CHECK_FALSE(signature.had_contrast());
  signature.learn(passing(300, 3, false), 1'000);
  CHECK(signature.had_contrast());
  for (int i = 0; i < 10; ++i) signature.learn({}, 500'000);
  REQUIRE_FALSE(signature.knows_multiplicity());
  CHECK(signature.had_contrast());
  signature.learn(passing(300, 2, false), 1'000);
  CHECK_FALSE(signature.had_contrast());
}

// Seen for so long, and surely the puck.
PuckSignature confirmed(int events_each, std::int64_t for_us) {
  PuckSignature signature;
  for (std::int64_t us = 0; us < for_us; us += 1'000) {
    signature.learn(passing(100, events_each, false), 1'000);
    signature.confirm(1'000);
  }
  return signature;
}

TEST_CASE("That a puck is faint is not forgotten with all else once it has been confirmed") {
  PuckSignature signature = confirmed(1, 301'000);
  signature.forget();
  CHECK_FALSE(signature.knows_multiplicity());
  CHECK(signature.contrast_sign() == 0);
  CHECK(signature.last_density() == 0);
  CHECK(signature.is_faint());
  CHECK(signature.may_be_faint());
  signature.forget();
  CHECK(signature.is_faint());
  // What is seen now counts more.
  signature.learn(passing(300, 3, false), 1'000);
  CHECK_FALSE(signature.is_faint());
  CHECK_FALSE(signature.may_be_faint());

  PuckSignature slow = confirmed(1, 301'000);
  for (int i = 0; i < 10; ++i) slow.learn({}, 500'000);
  REQUIRE_FALSE(slow.knows_multiplicity());
  CHECK(slow.is_faint());
}

TEST_CASE("What has not been confirmed for long, or is not faint, is forgotten") {
  PuckSignature brief = confirmed(1, 300'000);
  brief.forget();
  CHECK_FALSE(brief.is_faint());
  CHECK_FALSE(brief.may_be_faint());

  PuckSignature learned_only;
  for (int i = 0; i < 1'000; ++i) learned_only.learn(passing(100, 1, false), 1'000);
  learned_only.forget();
  CHECK_FALSE(learned_only.may_be_faint());

  // Nothing is confirmed of what is not known.
  PuckSignature unseen;
  for (int i = 0; i < 1'000; ++i) unseen.confirm(1'000);
  CHECK_FALSE(unseen.may_be_faint());

  // However long it was at once, it is no fainter than it has been seen.
  PuckSignature leapt = confirmed(5, 1'000);
  leapt.learn(passing(30'000, 2, false), 1'000);
  leapt.confirm(60'000'000);
  leapt.forget();
  CHECK_FALSE(leapt.may_be_faint());

  PuckSignature at_once;
  at_once.learn(passing(300, 1, false), 1'000);
  at_once.confirm(0);
  at_once.forget();
  CHECK_FALSE(at_once.may_be_faint());
  at_once.learn(passing(300, 1, false), 1'000);
  at_once.confirm(301'000);
  at_once.forget();
  CHECK(at_once.may_be_faint());

  PuckSignature doubtful = confirmed(2, 301'000);
  doubtful.forget();
  CHECK_FALSE(doubtful.may_be_faint());
}

TEST_CASE("Another puck than the faint one that was confirmed is soon known for what it is") {
  PuckSignature seen_briefly = confirmed(1, 5'000'000);
  for (int i = 0; i < 20; ++i) seen_briefly.learn({}, 500'000);
  seen_briefly.learn(passing(3'000, 5, false), 1'000);
  for (int i = 0; i < 20; ++i) seen_briefly.learn({}, 500'000);
  REQUIRE_FALSE(seen_briefly.knows_multiplicity());
  CHECK_FALSE(seen_briefly.may_be_faint());

  PuckSignature signature = confirmed(1, 5'000'000);
  for (int i = 0; i < 1'000; ++i) {
    signature.learn(passing(100, 5, false), 1'000);
    signature.confirm(1'000);
  }
  signature.forget();
  CHECK_FALSE(signature.may_be_faint());
}

TEST_CASE("Slow edges say nothing of the multiplicity") {
  PuckSignature signature;
  PuckSignature::Sample sample;
  for (int i = 0; i < 1000; ++i) sample.count(true, 50, true);
  signature.learn(sample, 1000);
  CHECK_FALSE(signature.knows_multiplicity());
}

TEST_CASE("What was learned is forgotten for what is seen now") {
  PuckSignature signature;
  signature.learn(passing(300, 1, false), 1000);
  for (int i = 0; i < 100; ++i) signature.learn(passing(100, 5, false), 20'000);
  CHECK(signature.multiplicity() == doctest::Approx(5).epsilon(0.01));
}

}  // namespace
}  // namespace puck
