#include "common/vision/contour_track.h"

#include <cmath>

#include <doctest/doctest.h>

#include "common/vision/challenger.h"
#include "tests/vision/contour_world.h"

namespace puck {
namespace {

double error_px(const ContourTrack& track, Pixel truth) {
  return distance_px(track.filter().position(), truth);
}

TEST_CASE("A track that starts 2 px off finds a moving puck to a few tenths of a pixel") {
  const ContourContext all = test::contour_context();
  const PixelVelocity velocity{700, 300};
  test::MovingContour puck(all.contour, {250, 180}, velocity);
  ContourTrack track(all, {.position = {252, 179}}, 0, 0);
  CHECK(test::follow(track, puck, all, 0, 60'000) < 0.25);
  CHECK(track.is_good());
  CHECK(track.quality() > 0.8);
  CHECK(track.filter().velocity().x == doctest::Approx(700).epsilon(0.05));
  CHECK(track.filter().velocity().y == doctest::Approx(300).epsilon(0.1));
  CHECK(track.looks().turning_px_s == all.contour.turning_px_s());
  CHECK(track.looks().slide == track.filter().slide());
}

TEST_CASE("A sensor's lag is made good") {
  ContourContext all = test::contour_context();
  test::MovingContour puck(all.contour, {200, 180}, {2000, 0});
  // Events that come 0.5 ms late show the puck 1 px behind.
  all.contour = PuckContour(test::kSensor, test::kSizeModel, {500, 0, 0}, true);
  ContourTrack track(all, {.position = {200, 180}, .velocity = {2000, 0}}, 500, 0);
  for (std::int64_t t = 0; t < 40'000; t += 1000) {
    for (ContourEvent event : puck.events(t, t + 1000)) {
      event.time_us += 500;
      track.take(event, all);
    }
    track.decide(t + 1500, false, all);
  }
  CHECK(error_px(track, puck.position_at(track.filter().time_us())) < 0.3);
}

TEST_CASE("Nothing is believed where events lie everywhere") {
  const ContourContext all = test::contour_context();
  ContourTrack track(all, {.position = {300, 200}}, 0, 0);
  std::uint32_t random = 1;
  for (std::int64_t t = 0; t < 40'000; t += 10) {
    random = random * 1664525u + 1013904223u;
    track.take({t, 270.0 + (random >> 8) % 60, 170.0 + (random >> 20) % 60, true, true}, all);
    if (t % 1000 == 0) track.decide(t, false, all);
  }
  CHECK_FALSE(track.is_good());
  CHECK(track.quality() < 0.2);
}

// A track of a puck of which every other event has the wrong sign.
ContourTrack track_of_mixed_signs(const ContourContext& context) {
  test::MovingContour puck(context.contour, {250, 180}, {700, 300});
  ContourTrack track(context, {.position = {250, 180}, .velocity = {700, 300}}, 0, 0);
  for (std::int64_t t = 0; t < 40'000; t += 1000) {
    bool on = false;
    for (ContourEvent event : puck.events(t, t + 1000)) {
      event.on = on = !on;
      track.take(event, context);
    }
    track.decide(t + 1000, false, context);
  }
  return track;
}

TEST_CASE("Signs that do not suit a disc of one tone make a track doubtful, unless purity is off") {
  ContourContext context = test::contour_context();
  CHECK_FALSE(track_of_mixed_signs(context).is_good());
  context.ingredients.polarity = false;
  CHECK_FALSE(track_of_mixed_signs(context).is_good());
  context.ingredients.purity = false;
  CHECK(track_of_mixed_signs(context).is_good());
}

TEST_CASE("While nothing is tracked, signs tell nothing until the speed is known") {
  ContourContext context = test::contour_context();
  context.ingredients.polarity = false;
  // At rest it is not; what little speed the filter makes of noise has any sign.
  const auto quality_of_slow_mixed = [&] {
    test::MovingContour puck(context.contour, {250, 180}, {60, 0}, 10);
    ContourTrack track(context, {.position = {250, 180}}, 0, 0);
    bool on = false;
    for (ContourEvent event : puck.events(0, 8'000)) {
      event.on = on = !on;
      track.take(event, context);
    }
    track.decide(8'000, false, context);
    return track.quality();
  };
  context.is_first = true;
  const double as_first = quality_of_slow_mixed();
  CHECK(as_first > 0.6);
  context.is_first = false;
  CHECK(quality_of_slow_mixed() < as_first);
}

// A track of a puck with a print on its face.
struct PrintedPuck {
  PrintedPuck(const ContourContext& all, PixelVelocity velocity)
      : context(all), track(context, {.position = position, .velocity = velocity}, 0, 0) {
    go_on(velocity);
  }
  // For 40 ms.
  void go_on(PixelVelocity velocity) {
    const double s = static_cast<double>(now_us) * 1e-6;
    test::MovingContour puck(context.contour,
                             {position.x - s * velocity.x, position.y - s * velocity.y}, velocity);
    puck.has_print = true;
    const std::int64_t end_us = now_us + 40'000;
    test::follow(track, puck, context, now_us, end_us);
    position = puck.position_at(end_us);
    now_us = end_us;
  }

  const ContourContext& context;
  Pixel position{250, 180};
  std::int64_t now_us = 0;
  ContourTrack track;
};

TEST_CASE("A print on the puck's face says nothing against it, unless face-print is off") {
  ContourContext context = test::contour_context();
  const PrintedPuck printed(context, {700, 300});
  CHECK(printed.track.quality() > 0.85);
  CHECK(error_px(printed.track, printed.position) < 0.3);
  context.ingredients.face_print = false;
  CHECK_FALSE(PrintedPuck(context, {700, 300}).track.is_good());
}

TEST_CASE("What covers a puck whose face is known to be plain is no print") {
  ContourContext context = test::contour_context();
  CHECK(PrintedPuck(context, {700, 300}).track.is_good());
  context.is_plain = true;
  CHECK_FALSE(PrintedPuck(context, {700, 300}).track.is_good());
}

TEST_CASE("A track gathers what tells a plain face from one with a print") {
  const ContourContext context = test::contour_context();
  const auto learned_of = [&](bool has_print) {
    ContourTrack track(context, {.position = {250, 180}, .velocity = {700, 300}}, 0, 0);
    test::MovingContour puck(context.contour, {250, 180}, {700, 300});
    puck.has_print = has_print;
    test::follow(track, puck, context, 0, 200'000);
    PuckSignature signature;
    signature.learn(track.take_sample(), 200'000);
    return signature;
  };
  CHECK(learned_of(false).has_plain_face());
  CHECK_FALSE(learned_of(true).has_plain_face());
}

TEST_CASE("To what has not moved by itself a print is clutter") {
  const ContourContext context = test::contour_context();
  const double fixed_px_s = context.contour.turning_px_s();
  CHECK_FALSE(PrintedPuck(context, {0.5 * fixed_px_s, 0}).track.is_good());
  PrintedPuck printed(context, {1.5 * fixed_px_s, 0});
  CHECK(printed.track.is_good());
  // It need not go on doing so.
  printed.go_on({0.5 * fixed_px_s, 0});
  CHECK(printed.track.filter().speed_px_s() < fixed_px_s);
  CHECK(printed.track.is_good());
}

TEST_CASE("What has not moved says how good it would be with a print, and without") {
  const ContourContext context = test::contour_context();
  const PrintedPuck printed(context, {0.5 * context.contour.turning_px_s(), 0});
  const TrackLooks looks = printed.track.looks();
  CHECK(looks.quality < 0.5);
  CHECK(looks.printed_quality > 0.85);
}

// A track of a dark puck that goes to the right, and where its leading edge is.
struct LeadingEdge {
  explicit LeadingEdge(const ContourContext& all)
      : context(all), track(context, {.position = {250, 180}, .velocity = {700, 0}}, 0, 0) {
    test::MovingContour puck(context.contour, {250, 180}, {700, 0});
    test::follow(track, puck, context, 0, 40'000);
    const Pixel at = track.filter().position();
    const ContourRing ring = context.contour.ring_at(at, 0);
    edge = {at.x + ring.semi_x, at.y - ring.rise};
  }
  // Of an event there.
  double worth(bool on, bool first) {
    return track.take({40'000, edge.x, edge.y, on, first}, context);
  }

  const ContourContext& context;
  ContourTrack track;
  Pixel edge;
};

TEST_CASE("An event of the wrong sign speaks against a track, unless polarity is off") {
  ContourContext context = test::contour_context();
  const auto worth = [&](bool on) { return LeadingEdge(context).worth(on, true); };
  CHECK(worth(false) > 0);
  CHECK(worth(true) == -1);
  context.ingredients.polarity = false;
  CHECK(worth(true) == worth(false));
}

TEST_CASE("A faint puck is followed by first events only, unless first-events is off") {
  ContourContext context = test::contour_context();
  const auto worth = [&](bool first) { return LeadingEdge(context).worth(false, first); };
  CHECK(worth(false) > 0);
  context.signature.learn({.quick_events = 150, .first_events = 100}, 0);
  REQUIRE(context.signature.is_faint());
  CHECK(worth(false) == 0);
  CHECK(worth(true) > 0);
  context.ingredients.first_events = false;
  CHECK(worth(false) > 0);
}

TEST_CASE("Many events in one direction are worth less, unless sector-saturation is off") {
  ContourContext context = test::contour_context();
  const auto worth_of_last = [&] {
    LeadingEdge edge(context);
    double worth = 0;
    for (int i = 0; i < 200; ++i) worth = edge.worth(false, true);
    return worth;
  };
  CHECK(worth_of_last() < 0.75);
  context.ingredients.sector_saturation = false;
  CHECK(worth_of_last() == 1);
}

// Of something round that is larger than the puck by so much.
PuckContour larger_contour(double wider_px) {
  PuckSizeModel larger = test::kSizeModel;
  larger.width_0 += 2 * wider_px;
  larger.height_0 += 2 * wider_px;
  return {test::kSensor, larger, {0, 0, 0}, true};
}

// A track of something round that is larger than the puck by so much, and darker than the table or
// brighter.
ContourTrack track_of_larger(double wider_px, ContourContext context, bool is_bright = false) {
  const PuckContour contour = larger_contour(wider_px);
  test::MovingContour mallet(contour, {250, 180}, {700, 300});
  context.filter.follows_size = context.ingredients.size_state;
  ContourTrack track(context, {.position = {250, 180}, .velocity = {700, 300}}, 0, 0);
  for (std::int64_t t = 0; t < 60'000; t += 1'000) {
    for (ContourEvent event : mallet.events(t, t + 1'000)) {
      event.on = event.on != is_bright;
      track.take(event, context);
    }
    track.decide(t + 1'000, false, context);
  }
  return track;
}

TEST_CASE("A larger contour is followed as one, unless size-state is off") {
  ContourContext context = test::contour_context();
  CHECK(std::abs(track_of_larger(0.5, context).filter().growth_px() - 0.5) < 0.2);
  context.ingredients.size_state = false;
  CHECK(track_of_larger(0.5, context).filter().growth_px() == 0);
}

TEST_CASE("What is too large makes a track doubtful, unless size-penalty is off") {
  ContourContext context = test::contour_context();
  const double doubted = track_of_larger(1, context).quality();
  context.ingredients.size_penalty = false;
  CHECK(doubted < 0.7 * track_of_larger(1, context).quality());
}

// … in a context where the puck is known to be bright.
ContourContext bright_context() {
  ContourContext context = test::contour_context();
  context.signature.learn({.signed_speed = 10'000, .absolute_speed = 10'000}, 1'000);
  return context;
}

TEST_CASE("A bright puck looks larger than it is, which does not make it doubtful") {
  ContourContext context = bright_context();
  const TrackLooks bright = track_of_larger(0.6, context, true).looks();
  CHECK(bright.growth_px < 0.2);
  CHECK(bright.has_pucks_size());

  SUBCASE("unless ingredient bloom is off") { context.ingredients.bloom = false; }
  SUBCASE("unless it is not known whether the puck is bright") { context.signature = {}; }
  SUBCASE("unless the puck is known to be dark") {
    context.signature = {};
    context.signature.learn({.signed_speed = -10'000, .absolute_speed = 10'000}, 1'000);
  }
  const TrackLooks dark = track_of_larger(0.6, context, true).looks();
  CHECK(dark.growth_px == doctest::Approx(0.6).epsilon(0.2));
  CHECK_FALSE(dark.has_pucks_size());
}

TEST_CASE("A bright puck that looks much larger than it is stays beyond doubt") {
  const double with_bloom = track_of_larger(0.75, bright_context(), true).quality();
  CHECK(with_bloom > 1.3 * track_of_larger(0.75, test::contour_context(), true).quality());
}

TEST_CASE("A bright puck that does not look larger than it is has a puck's size") {
  const ContourContext context = bright_context();
  for (const double wider_px : {0.0, -0.3}) {
    const ContourTrack track = track_of_larger(wider_px, context, true);
    CHECK(track.looks().growth_px ==
          doctest::Approx(std::min(track.filter().growth_px(), 0.0)).epsilon(0.01));
    CHECK(track.looks().has_pucks_size());
  }
}

TEST_CASE("What is larger than brightness makes a puck is doubtful") {
  const TrackLooks mallet = track_of_larger(1.5, bright_context(), true).looks();
  CHECK(mallet.is_oversized());
  CHECK(mallet.quality < 0.7);
}

// … that is smaller by so much and moves so fast.
TrackLooks looks_of_smaller(double narrower_px, PixelVelocity velocity,
                            const ContourContext& context) {
  const PuckContour contour = larger_contour(-narrower_px);
  test::MovingContour puck(contour, {60, 200}, velocity);
  ContourTrack track(context, {.position = {60, 200}, .velocity = velocity}, 0, 0);
  for (std::int64_t t = 0; t < 60'000; t += 1'000) {
    for (const ContourEvent& event : puck.events(t, t + 1'000)) track.take(event, context);
    track.decide(t + 1'000, false, context);
  }
  return track.looks();
}

TEST_CASE("A fast puck may look smaller than it is") {
  ContourContext context = test::contour_context();
  const TrackLooks fast = looks_of_smaller(0.75, {4'000, 0}, context);
  CHECK(std::abs(fast.growth_px + 0.3) < 0.1);
  CHECK(fast.has_pucks_size());

  PixelVelocity velocity{4'000, 0};
  SUBCASE("unless ingredient smear is off") { context.ingredients.smear = false; }
  SUBCASE("unless it is not that fast") { velocity = {1'000, 0}; }
  const TrackLooks small = looks_of_smaller(0.75, velocity, context);
  CHECK(std::abs(small.growth_px + 0.75) < 0.1);
  CHECK_FALSE(small.has_pucks_size());
}

TEST_CASE("… but not smaller by any amount") {
  const TrackLooks fastest = looks_of_smaller(1.2, {8'000, 0}, test::contour_context());
  CHECK(std::abs(fastest.growth_px + 0.6) < 0.1);
}

// … that is larger by so much and comes in at the image's right border, in a context where the puck
// is known to have good contrast, and to have left there.
ContourTrack track_of_larger_at_border(double wider_px, const ContourContext& context) {
  const PuckContour contour = larger_contour(wider_px);
  test::MovingContour puck(contour, {642, 180}, {-200, 600});
  ContourTrack track(context, {.position = {640, 180}, .velocity = {-200, 600}}, 0, 0);
  for (std::int64_t t = 0; t < 20'000; t += 1'000) {
    for (const ContourEvent& event : puck.events(t, t + 1'000)) {
      if (event.x < test::kSensor.width) track.take(event, context);
    }
    track.decide(t + 1'000, false, context);
  }
  return track;
}

ContourContext clear_context() {
  ContourContext context = test::contour_context();
  context.signature.learn({.quick_events = 400, .first_events = 100}, 1'000);
  context.may_be_aside = true;
  return context;
}

TEST_CASE(
    "A puck that comes in at the image's side may be larger, and is seen as far as it is in") {
  ContourContext context = clear_context();
  const TrackLooks looks = track_of_larger_at_border(1, context).looks();
  CHECK_FALSE(looks.is_oversized());
  CHECK(looks.cover > 0.6);
  CHECK(looks.quality > 0.8);

  SUBCASE("unless image-sides is off") { context.ingredients.image_sides = false; }
  SUBCASE("unless the puck has been elsewhere") { context.may_be_aside = false; }
  SUBCASE("unless it is not known to have good contrast") { context.signature = {}; }
  const TrackLooks strict = track_of_larger_at_border(1, context).looks();
  CHECK(strict.is_oversized());
  CHECK(strict.cover < 0.6);
  CHECK(strict.quality < looks.quality - 0.2);
}

TEST_CASE("What is larger than the image's side makes a puck is followed, but doubtful") {
  const ContourTrack mallet = track_of_larger_at_border(2.5, clear_context());
  CHECK(mallet.filter().growth_px() > 1.2);
  CHECK(mallet.looks().is_oversized());
}

// What a sensor is late by.
constexpr std::int64_t kLag_us = 1'000;

// The quality of a track of a puck whose wall has another tone than its face, so that both its
// whole contour, which is followed, and its face's lower edge make events.
double quality_of_two_toned(const ContourContext& context, PixelVelocity velocity) {
  test::MovingContour whole(context.contour, {300, 180}, velocity);
  test::MovingContour face(context.contour, {300, 180}, velocity, 3,
                           context.contour.other_wall_share());
  ContourTrack track(context, {.position = {300, 180}, .velocity = velocity}, 0, 0);
  for (std::int64_t t = 0; t < 60'000; t += 1'000) {
    const auto show = [&](ContourEvent event) {
      event.time_us += kLag_us;
      track.take(event, context);
    };
    for (const ContourEvent& event : whole.events(t, t + 1'000)) show(event);
    const double lowest_edge_y = face.position_at(t).y;
    for (const ContourEvent& event : face.events(t, t + 1'000)) {
      if (event.y > lowest_edge_y) show(event);
    }
    track.decide(t + 1'000 + kLag_us, false, context);
  }
  CHECK(error_px(track, whole.position_at(60'000 + kLag_us)) < 1);
  return track.quality();
}

TEST_CASE("The edge between face and wall says nothing against a puck, unless wall-edge is off") {
  ContourContext context = test::contour_context();
  context.contour = PuckContour(test::kSensor, test::kSizeModel, {kLag_us, 0, 0}, true);
  const PixelVelocity slow{100, 200};
  const PixelVelocity fast{100, 1'500};
  CHECK(quality_of_two_toned(context, slow) > 0.9);
  CHECK(quality_of_two_toned(context, fast) > 0.9);
  context.ingredients.wall_edge = false;
  CHECK(quality_of_two_toned(context, slow) < 0.8);
  context.ingredients.wall_edge = true;
  context.ingredients.wall = false;
  CHECK(quality_of_two_toned(context, slow) < 0.8);
}

TEST_CASE("A hot pixel on the other edge does not make a puck at rest look disturbed") {
  const ContourContext context = test::contour_context();
  const ContourRing face = context.contour.ring_at({300, 180}, context.contour.other_wall_share());
  ContourTrack track(context, {.position = {300, 180}}, 0, 0);
  for (std::int64_t t = 1'000; t < 1'000'000; t += 1'000) {
    track.take({t, 300, std::round(180 - face.rise + face.semi_y), true, false}, context);
    track.decide(t, false, context);
    track.park();
  }
  CHECK(track.looks().near_events < 2);
  CHECK(track.looks().inside_events < 2);
}

TEST_CASE("What lies on the other edge says that something happens, and may be on the puck") {
  const ContourContext context = test::contour_context();
  const ContourRing face = context.contour.ring_at({300, 180}, context.contour.other_wall_share());
  ContourTrack track(context, {.position = {300, 180}}, 0, 0);
  for (int i = -3; i <= 3; ++i) {
    track.take({1'000, 300.0 + i, std::round(180 - face.rise + face.semi_y), true, true}, context);
  }
  CHECK(track.looks().near_events == 7);
  CHECK(track.looks().inside_events == 7);
}

TEST_CASE("A twin at rest overtakes a track that missed a bounce, and only then") {
  const ContourContext all = test::contour_context();
  test::MovingContour before(all.contour, {250, 180}, {2500, 0});
  ContourTrack track(all, {.position = {250, 180}, .velocity = {2500, 0}}, 0, 0);
  test::follow(track, before, all, 0, 20'000);
  const Pixel wall = before.position_at(20'000);

  const auto twin_leads = [&](PixelVelocity after) {
    ContourTrack main = track;
    test::MovingContour puck(all.contour, wall, after);
    Challenger twin(Challenger::Kind::kTwin, all, {.position = main.filter().position()}, 20'000, 0,
                    {});
    for (ContourEvent event : puck.events(0, 4'000)) {
      event.time_us += 20'000;
      twin.take(event, main.take(event, all), all);
    }
    return twin.leads();
  };
  CHECK(twin_leads({-2200, 0}));
  CHECK_FALSE(twin_leads({2500, 0}));
}

TEST_CASE("A hot pixel neither moves a puck at rest nor makes it look disturbed") {
  const ContourContext all = test::contour_context();
  ContourTrack track(all, {.position = {300, 200}}, 0, 0);
  const ContourRing ring = all.contour.ring_at({300, 200}, 0);
  for (std::int64_t t = 1'000; t <= 100'000; t += 1'000) {
    track.take({t, 300 + std::floor(ring.semi_x), 200 - std::floor(ring.rise), true, true}, all);
    track.decide(t, false, all);
    track.park();
    if (t > 20'000) CHECK(track.looks().is_quiet());
  }
  CHECK(error_px(track, {300, 200}) < 0.5);
}

TEST_CASE("A challenger convinces for as long as it does so without a break") {
  const ContourContext all = test::contour_context();
  Challenger challenger(Challenger::Kind::kSearch, all, {.position = {300, 200}}, 0, 0, {});
  CHECK(challenger.convincing_for_us(true, 1000) == 0);
  CHECK(challenger.convincing_for_us(true, 3000) == 2000);
  CHECK(challenger.convincing_for_us(false, 4000) == 0);
  CHECK(challenger.convincing_for_us(true, 5000) == 0);
}

}  // namespace
}  // namespace puck
