#include "common/vision/witness_check.h"

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

using test::kContext;

TEST_CASE("The witness agrees within a quarter of the puck's width") {
  WitnessCheck witness;
  witness.put({300, 200}, 0);
  const double width = kContext.contour.size_at({300, 200}).width;
  CHECK(witness.agrees({300 + 0.24 * width, 200}, kContext));
  CHECK_FALSE(witness.agrees({300 + 0.26 * width, 200}, kContext));
}

TEST_CASE(
    "It is near where it agrees, and within 4.5 px, since the blob of a small puck is drawn off") {
  WitnessCheck witness;
  const Pixel far_end{300, 30};
  witness.put(far_end, 0);
  REQUIRE(kContext.contour.size_at(far_end).width < 18);
  CHECK_FALSE(witness.agrees({far_end.x + 4.4, far_end.y}, kContext));
  CHECK(witness.is_near({far_end.x + 4.4, far_end.y}, kContext));
  CHECK_FALSE(witness.is_near({far_end.x + 4.6, far_end.y}, kContext));
  witness.put({300, 400}, 0);
  const double width = kContext.contour.size_at({300, 400}).width;
  CHECK(witness.is_near({300 + 0.24 * width, 400}, kContext));
  CHECK_FALSE(witness.is_near({300 + 0.26 * width, 400}, kContext));
}

TEST_CASE("It vouches only for a puck that makes more than one event at a pixel") {
  ContourContext context = kContext;
  WitnessCheck witness;
  witness.put({300, 200}, 0);
  CHECK_FALSE(witness.vouches({300, 200}, context));
  context.signature.learn({.quick_events = 500, .first_events = 100}, 0);
  CHECK(witness.vouches({300, 200}, context));
  CHECK_FALSE(witness.vouches({330, 200}, context));
  context.ingredients.witness = false;
  CHECK_FALSE(witness.vouches({300, 200}, context));
  context = kContext;
  context.signature.learn({.quick_events = 150, .first_events = 100}, 0);
  CHECK_FALSE(witness.vouches({300, 200}, context));
}

TEST_CASE("Where the witness disagrees it challenges the track, once a millisecond") {
  const ContourTrack main(kContext, {.position = {300, 200}}, 0, 0);
  WitnessCheck witness;
  Challengers challengers;
  witness.put({300, 200}, 0);
  witness.consult(main, kContext, 1'000, challengers);
  CHECK(test::count(challengers) == 0);
  witness.put({330, 200}, 1'000);
  witness.consult(main, kContext, 1'500, challengers);
  witness.consult(main, kContext, 2'000, challengers);
  REQUIRE(test::count(challengers) == 1);
  CHECK(challengers.begin()->kind() == Challenger::Kind::kWitness);
  CHECK(challengers.begin()->track().filter().position() == Pixel{330, 200});
  witness.consult(main, kContext, 2'500, challengers);
  CHECK(test::count(challengers) == 2);
}

TEST_CASE("Switched off, or for a faint puck, it does not speak up") {
  const ContourTrack main(kContext, {.position = {300, 200}}, 0, 0);
  ContourContext off = kContext;
  off.ingredients.witness = false;
  ContourContext faint = kContext;
  faint.signature.learn({.quick_events = 150, .first_events = 100}, 0);
  for (const ContourContext& context : {off, faint}) {
    WitnessCheck witness;
    Challengers challengers;
    witness.put({330, 200}, 0);
    witness.consult(main, context, 50'000, challengers);
    CHECK(test::count(challengers) == 0);
  }
}

TEST_CASE("A witness that is astray of a good track for more than 20 ms is put back") {
  test::MovingContour puck(kContext.contour, {200, 200}, {700, 200});
  ContourTrack main(kContext, {.position = {200, 200}, .velocity = {700, 200}}, 0, 0);
  test::follow(main, puck, kContext, 0, 40'000);
  REQUIRE(main.is_good());
  WitnessCheck witness;
  Challengers challengers;
  witness.put({400, 400}, 40'000);
  witness.consult(main, kContext, 60'000, challengers);
  CHECK(witness.position() == Pixel{400, 400});
  witness.consult(main, kContext, 60'001, challengers);
  CHECK(witness.position() == main.filter().position());
}

}  // namespace
}  // namespace puck
