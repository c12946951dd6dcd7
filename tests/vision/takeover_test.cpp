#include "common/vision/takeover.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

using Kind = Challenger::Kind;

// Beyond doubt in all respects; no rule applies against it.
constexpr Defence kStrongMain{.looks = {.quality = 0.9, .strength = 100},
                              .is_trusted = true,
                              .is_proven = true,
                              .is_witnessed = true};
constexpr Defence kBadMain{.looks = {.quality = 0.3, .strength = 10}, .is_trusted = true};

TEST_CASE("A twin and a witness win by a lead, the other opinion on the wall as a good track") {
  Claim claim{.age_us = 1'501, .leads = true};
  CHECK(wins_test(Kind::kTwin, claim));
  CHECK(wins_test(Kind::kWitness, claim));
  claim.age_us = 1'500;
  CHECK_FALSE(wins_test(Kind::kTwin, claim));
  claim.age_us = 900;
  CHECK_FALSE(wins_test(Kind::kWitness, claim));
  claim.age_us = 15'001;
  CHECK_FALSE(wins_test(Kind::kWall, claim));
  claim.looks = {.quality = 0.51, .strength = 7};
  CHECK(wins_test(Kind::kWall, claim));
  CHECK_FALSE(wins_test(Kind::kSearch, claim));
  claim.looks.growth_px = 0.45;
  CHECK_FALSE(wins_test(Kind::kWall, claim));
  claim.looks.growth_px = 0;
  claim.leads = false;
  CHECK_FALSE(wins_test(Kind::kTwin, claim));
  CHECK_FALSE(wins_test(Kind::kWitness, claim));
  CHECK_FALSE(wins_test(Kind::kWall, claim));
}

TEST_CASE("What the correlation scores above 0.65 is evident after 5 ms if its events agree") {
  const Claim evident{
      .looks = {.quality = 0.66, .strength = 11}, .age_us = 5'001, .found = {.score = 0.66}};
  CHECK(is_evident(evident));
  Claim claim = evident;
  claim.found.score = 0.65;
  CHECK_FALSE(is_evident(claim));
  claim = evident;
  claim.looks.quality = 0.65;
  CHECK_FALSE(is_evident(claim));
  claim = evident;
  claim.age_us = 5'000;
  CHECK_FALSE(is_evident(claim));
}

constexpr Claim kMoving{
    .looks = {.speed_px_s = 301, .quality = 0.76, .strength = 26, .cover = 0.36}, .age_us = 12'001};
constexpr Claim kLeading = [] {
  Claim claim = kMoving;
  claim.leads = true;
  return claim;
}();

TEST_CASE("What is faster than the head turns, in all directions, moves by itself") {
  CHECK(moves_by_itself(kMoving));
  Claim claim = kMoving;
  claim.looks.speed_px_s = 300;
  CHECK_FALSE(moves_by_itself(claim));
  claim.looks.turning_px_s = 299;
  CHECK(moves_by_itself(claim));
  claim = kMoving;
  claim.looks.cover = 0.35;
  CHECK_FALSE(moves_by_itself(claim));
}

TEST_CASE("A ring that looks larger than the puck's is a mallet's, however fast it is") {
  Claim claim = kMoving;
  claim.looks.growth_px = 0.44;
  CHECK(moves_by_itself(claim));
  claim.looks.growth_px = 0.45;
  CHECK_FALSE(moves_by_itself(claim));
}

TEST_CASE("While the head rests a whole ring of the right size moves by itself from 100 px/s") {
  Claim slow = kMoving;
  slow.looks.speed_px_s = 101;
  slow.looks.cover = 0.51;
  slow.context.head_rests = true;
  CHECK(moves_by_itself(slow));
  Claim claim = slow;
  claim.context.head_rests = false;
  CHECK_FALSE(moves_by_itself(claim));
  claim = slow;
  claim.looks.speed_px_s = 100;
  CHECK_FALSE(moves_by_itself(claim));
  claim = slow;
  claim.looks.cover = 0.5;
  CHECK_FALSE(moves_by_itself(claim));
  claim = slow;
  claim.looks.growth_px = 0.35;
  CHECK_FALSE(moves_by_itself(claim));
}

TEST_CASE(
    "What is three times as strong takes over wherever it is, from a sound track if evident") {
  Claim claim{.looks = {.position = {500, 0}, .quality = 0.76, .strength = 301}, .age_us = 10'001};
  Defence main = kStrongMain;
  CHECK_FALSE(is_convincing(claim, main));
  main.since_sound_us = 150'001;
  CHECK(outshines(claim, main));
  CHECK(is_convincing(claim, main));
  claim.looks.strength = 300;
  CHECK_FALSE(is_convincing(claim, main));
  claim.looks.strength = 301;
  claim.found.score = 0.66;
  CHECK(is_convincing(claim, kStrongMain));
}

TEST_CASE("What searches hardly see as a puck outshines nothing, however strong it is") {
  Claim claim{.looks = {.position = {500, 0}, .quality = 0.76, .strength = 301},
              .age_us = 10'001,
              .found = {.score = 0.33}};
  Defence main = kStrongMain;
  main.since_sound_us = 150'001;
  main.knows_pucks = true;
  CHECK_FALSE(outshines(claim, main));
  claim.found.score = 0.34;
  CHECK(outshines(claim, main));
}

constexpr Claim kFollowed{
    .looks = {.quality = 0.36, .strength = 6},
    .found = {.score = 0.5, .trail = {.sightings = 8, .own_px = 11, .score = 0.4, .rms_px = 0.9}}};

TEST_CASE("What searches have followed takes over on few events, unless the track was just good") {
  const Defence main{.looks = {.quality = 0.4, .strength = 30},
                     .is_trusted = true,
                     .is_proven = true,
                     .may_be_faint = true,
                     .since_good_us = 20'001};
  const auto follows = [&main](auto change) {
    Claim claim = kFollowed;
    change(claim);
    CHECK(is_followed(claim, main) == is_convincing(claim, main));
    return is_followed(claim, main);
  };
  CHECK(follows([](Claim&) {}));
  CHECK_FALSE(follows([](Claim& claim) { claim.looks.quality = 0.35; }));
  CHECK_FALSE(follows([](Claim& claim) { claim.looks.strength = 5; }));
  CHECK_FALSE(follows([](Claim& claim) { claim.looks.growth_px = 0.45; }));
  CHECK_FALSE(follows([](Claim& claim) { claim.looks.growth_px = -0.6; }));
  CHECK_FALSE(follows([](Claim& claim) { claim.found.trail.sightings = 7; }));
  CHECK_FALSE(follows([](Claim& claim) { claim.found.trail.own_px = 10; }));
  CHECK_FALSE(follows([](Claim& claim) { claim.found.trail.score = 0.39; }));
  CHECK_FALSE(follows([](Claim& claim) { claim.found.trail.rms_px = 0.91; }));
  Defence good = main;
  good.since_good_us = 20'000;
  CHECK_FALSE(is_convincing(kFollowed, good));
  Defence clear = main;
  clear.may_be_faint = false;
  CHECK_FALSE(is_convincing(kFollowed, clear));
}

TEST_CASE("What leads inherits from a track that has just lost all of its events") {
  const Defence deserted{.looks = {.position = {340, 200}, .quality = 0.19, .strength = 4},
                         .is_trusted = true,
                         .is_proven = true,
                         .knows_pucks = true,
                         .score = 0.5,
                         .since_good_us = 2'001};
  const Claim heir{.looks = {.position = {300, 200},
                             .speed_px_s = 301,
                             .quality = 0.81,
                             .strength = 17,
                             .cover = 0.41},
                   .age_us = 3'000,
                   .found = {.score = 0.46},
                   .leads = true};
  const auto inherits_if = [&](auto change) {
    Claim claim = heir;
    Defence main = deserted;
    change(claim, main);
    CHECK(inherits(claim, main) == is_convincing(claim, main));
    return inherits(claim, main);
  };
  CHECK(inherits_if([](Claim&, Defence&) {}));
  CHECK_FALSE(inherits_if([](Claim& claim, Defence&) { claim.leads = false; }));
  CHECK_FALSE(inherits_if([](Claim& claim, Defence&) { claim.looks.speed_px_s = 300; }));
  CHECK_FALSE(inherits_if([](Claim& claim, Defence&) { claim.looks.quality = 0.8; }));
  CHECK_FALSE(inherits_if([](Claim& claim, Defence& main) {
    claim.looks.strength = 15;
    main.looks.strength = 3;
  }));
  CHECK_FALSE(inherits_if([](Claim& claim, Defence&) { claim.looks.cover = 0.4; }));
  CHECK_FALSE(inherits_if([](Claim& claim, Defence&) { claim.looks.growth_px = 0.35; }));
  CHECK_FALSE(inherits_if([](Claim& claim, Defence&) { claim.looks.growth_px = -0.35; }));
  CHECK_FALSE(inherits_if([](Claim& claim, Defence&) { claim.found.score = 0.45; }));
  CHECK_FALSE(inherits_if([](Claim& claim, Defence&) { claim.looks.position.x = 280; }));
  CHECK_FALSE(inherits_if([](Claim&, Defence& main) { main.since_good_us = 2'000; }));
  CHECK(inherits_if([](Claim&, Defence& main) { main.since_good_us = 20'000; }));
  CHECK_FALSE(inherits_if([](Claim&, Defence& main) { main.looks.quality = 0.2; }));
  CHECK_FALSE(inherits_if([](Claim&, Defence& main) { main.looks.strength = 4.25; }));
  CHECK_FALSE(inherits_if([](Claim&, Defence& main) { main.knows_pucks = false; }));
  Defence long_gone = deserted;
  long_gone.since_good_us = 20'001;
  CHECK_FALSE(inherits(heir, long_gone));
  Defence resting = deserted;
  resting.is_resting = true;
  CHECK_FALSE(is_convincing(heir, resting));
}

TEST_CASE("What searches have followed for long needs no events, and was not found weakly") {
  const Defence main{
      .is_trusted = true, .is_proven = true, .may_be_faint = true, .since_good_us = 20'001};
  Claim claim{.found = {.score = 0.5,
                        .trail = {.sightings = 12, .own_px = 15, .score = 0.5, .rms_px = 0.8}}};
  CHECK(is_convincing(claim, main));
  CHECK_FALSE(is_weakly_found(claim, std::nullopt));
  Defence resting = main;
  resting.is_resting = true;
  CHECK_FALSE(is_convincing(claim, resting));
  claim.found.trail.sightings = 11;
  CHECK_FALSE(is_convincing(claim, main));
  CHECK(is_weakly_found(claim, std::nullopt));
}

TEST_CASE("A puck at rest gives way to what is evident only, however weak it looks itself") {
  Defence main{
      .looks = {.quality = 0, .strength = 0}, .is_proven = true, .since_sound_us = 1'000'000};
  Claim mallet{.looks = {.quality = 0.9, .strength = 500}, .age_us = 30'000};
  CHECK(is_convincing(mallet, main));
  main.is_resting = true;
  CHECK_FALSE(is_convincing(mallet, main));
  mallet.found.score = 0.66;
  CHECK(is_convincing(mallet, main));
}

TEST_CASE("So does one that was only ever slow, if it is trusted") {
  Defence main{.is_resting = true, .since_sound_us = 1'000'000};
  const Claim mallet{.looks = {.quality = 0.9, .strength = 500}, .age_us = 30'000};
  CHECK(is_convincing(mallet, main));
  main.is_trusted = true;
  CHECK_FALSE(is_convincing(mallet, main));
}

// What just outruns a rest; anything less is checked not to.
Claim checked_outrunning(const Defence& main) {
  Claim claim = kMoving;
  claim.looks.quality = 0.86;
  claim.looks.strength = 41;
  CHECK(is_convincing(claim, main));
  claim.looks.strength = 40;
  CHECK_FALSE(is_convincing(claim, main));
  claim.looks.strength = 41;
  claim.looks.quality = 0.85;
  CHECK_FALSE(is_convincing(claim, main));
  // A whole ring of its size may look a little worse.
  claim.looks.cover = 0.51;
  CHECK(is_convincing(claim, main));
  claim.looks.growth_px = 0.35;
  CHECK_FALSE(is_convincing(claim, main));
  claim.looks.growth_px = 0;
  claim.looks.quality = 0.78;
  CHECK_FALSE(is_convincing(claim, main));
  claim.looks = kMoving.looks;
  claim.looks.quality = 0.86;
  claim.looks.strength = 41;
  return claim;
}

TEST_CASE("A faint puck, which is never evident, outruns where it was taken to rest") {
  Defence main{.is_proven = true, .is_resting = true, .may_be_faint = true};
  Claim claim = checked_outrunning(main);
  CHECK(outruns_rest(claim, main));
  claim.looks.speed_px_s = 300;
  CHECK_FALSE(is_convincing(claim, main));
  claim.looks.speed_px_s = 301;
  main.may_be_faint = false;
  CHECK_FALSE(is_convincing(claim, main));
}

TEST_CASE("What moves beyond doubt outruns a rest that is trusted, but was never seen to move") {
  Defence main{.is_trusted = true, .is_resting = true};
  const Claim claim = checked_outrunning(main);
  main.is_proven = true;
  CHECK_FALSE(is_convincing(claim, main));
}

TEST_CASE("A puck at rest that was covered 200 ms ago is outrun by a whole ring of its size") {
  Defence main{.is_proven = true,
               .may_be_overtaken = true,
               .is_resting = true,
               .was_covered = true,
               .since_good_us = 200'001};
  Claim claim = kMoving;
  claim.looks.quality = 0.86;
  claim.looks.strength = 41;
  claim.looks.cover = 0.51;
  CHECK(is_convincing(claim, main));
  main.since_good_us = 200'000;
  CHECK_FALSE(is_convincing(claim, main));
  main.since_good_us = 200'001;
  main.may_be_overtaken = false;
  CHECK_FALSE(is_convincing(claim, main));
  main.may_be_overtaken = true;
  main.was_covered = false;
  CHECK_FALSE(is_convincing(claim, main));
  main.was_covered = true;
  claim.looks.cover = 0.5;
  CHECK_FALSE(is_convincing(claim, main));
  claim.looks.cover = 0.51;
  claim.looks.growth_px = 0.35;
  CHECK_FALSE(is_convincing(claim, main));
}

// What is just recognised, by a high score.
constexpr Claim kRecognised{
    .looks = {.growth_px = 0.44, .quality = 0.51, .strength = 11, .cover = 0.41},
    .age_us = 6'001,
    .found = {.score = 0.61},
    .leads = true};
constexpr Defence kGoneBad{.looks = {.position = {500, 0}},
                           .is_trusted = true,
                           .is_proven = true,
                           .knows_pucks = true,
                           .since_good_us = 20'001};

TEST_CASE("What the correlation and its events together say is a puck is recognised") {
  CHECK(is_recognised(kRecognised, kGoneBad));
  CHECK(is_convincing(kRecognised, kGoneBad));
  const auto is_still_recognised = [](auto change) {
    Claim claim = kRecognised;
    change(claim);
    return is_recognised(claim, kGoneBad);
  };
  CHECK_FALSE(is_still_recognised([](Claim& claim) { claim.leads = false; }));
  CHECK_FALSE(is_still_recognised([](Claim& claim) { claim.age_us = 6'000; }));
  CHECK_FALSE(is_still_recognised([](Claim& claim) { claim.looks.strength = 10; }));
  CHECK_FALSE(is_still_recognised([](Claim& claim) { claim.looks.cover = 0.4; }));
  CHECK_FALSE(is_still_recognised([](Claim& claim) { claim.looks.growth_px = 0.45; }));
  CHECK_FALSE(is_still_recognised([](Claim& claim) { claim.looks.growth_px = -0.6; }));
  // However high the score, its events must not contradict.
  CHECK_FALSE(is_still_recognised([](Claim& claim) {
    claim.looks.quality = 0.5;
    claim.found.score = 0.9;
  }));
}

TEST_CASE("What is clear beyond doubt is recognised after 3 ms") {
  Claim claim = kRecognised;
  claim.age_us = 3'001;
  claim.looks.quality = 0.91;
  claim.looks.strength = 41;
  CHECK(is_recognised(claim, kGoneBad));
  claim.looks.strength = 40;
  CHECK_FALSE(is_recognised(claim, kGoneBad));
  claim.looks = {.quality = 0.9, .strength = 41, .cover = 0.41};
  CHECK_FALSE(is_recognised(claim, kGoneBad));
  claim.looks.quality = 0.91;
  claim.age_us = 3'000;
  CHECK_FALSE(is_recognised(claim, kGoneBad));
}

TEST_CASE("A lower score is made up for by events that say more, of what moves") {
  Claim claim = kRecognised;
  claim.found.score = 0.46;
  claim.looks.quality = 0.79;
  claim.looks.speed_px_s = 101;
  CHECK(is_recognised(claim, kGoneBad));
  claim.looks.quality = 0.77;
  CHECK_FALSE(is_recognised(claim, kGoneBad));
  claim.looks.quality = 0.79;
  claim.looks.speed_px_s = 100;
  CHECK_FALSE(is_recognised(claim, kGoneBad));
  claim.looks.speed_px_s = 101;
  claim.looks.quality = 0.99;
  claim.found.score = 0.45;
  CHECK_FALSE(is_recognised(claim, kGoneBad));
}

TEST_CASE("Nothing is recognised while the main track is good, or the ingredient is off") {
  Defence main = kGoneBad;
  main.since_good_us = 20'000;
  CHECK_FALSE(is_recognised(kRecognised, main));
  main = kGoneBad;
  main.knows_pucks = false;
  CHECK_FALSE(is_recognised(kRecognised, main));
}

// Clear at once, and nothing more.
constexpr Claim kClear{.looks = {.position = {500, 100},
                                 .speed_px_s = 400,
                                 .quality = 0.9,
                                 .strength = 61,
                                 .cover = 0.3},
                       .age_us = 1'500,
                       .leads = true};

Claim without_at_once(Claim claim) {
  claim.context.at_once = false;
  return claim;
}

TEST_CASE("What is clear at once is recognised at once, and unmasks an unsound track") {
  REQUIRE(is_clear_at_once(kClear));
  const Defence gone_bad{
      .is_trusted = true, .is_proven = true, .knows_pucks = true, .since_good_us = 20'001};
  CHECK(is_recognised(kClear, gone_bad));
  CHECK_FALSE(is_recognised(without_at_once(kClear), gone_bad));
  Defence good = gone_bad;
  good.since_good_us = 20'000;
  CHECK_FALSE(is_recognised(kClear, good));

  const Defence unsound{.looks = {.quality = 0.79}, .is_trusted = true, .since_sound_us = 150'001};
  CHECK(unmasks(kClear, unsound));
  CHECK_FALSE(unmasks(without_at_once(kClear), unsound));
  Defence sound = unsound;
  sound.since_sound_us = 150'000;
  CHECK_FALSE(unmasks(kClear, sound));
}

// Likely, evident, or neither, but waited for.
constexpr Claim kLikely{.looks = {.quality = 0.8, .strength = 20, .cover = 0.6},
                        .age_us = 11'000,
                        .found = {.score = 0.6}};
constexpr Claim kEvident{
    .looks = {.quality = 0.7, .strength = 20}, .age_us = 8'000, .found = {.score = 0.7}};
constexpr Claim kPrintedAtRest{
    .looks = {.printed_quality = 0.8, .strength = 50, .cover = 0.8, .inside_events = 60},
    .age_us = 12'000,
    .found = {.score = 0.65},
    .leads = true};
constexpr Claim kAwaited{.looks = {.quality = 0.81, .strength = 31, .cover = 0.51},
                         .age_us = 20'001};

constexpr Claim kLying{.looks = {.quality = 0.76, .strength = 13, .cover = 0.61},
                       .age_us = 15'001,
                       .leads = true,
                       .own_speed_px_s = 0};

TEST_CASE("What rests in the scene is the first after 150 ms, and was not found weakly") {
  REQUIRE(rests_in_scene(kLying));
  CHECK_FALSE(is_convincing_as_first(kLying, 150'000));
  CHECK(is_convincing_as_first(kLying, 150'001));
  CHECK_FALSE(is_weakly_found(kLying, std::nullopt));
  Claim claim = kLying;
  claim.own_speed_px_s = 100;
  CHECK_FALSE(is_convincing_as_first(claim, 150'001));
  CHECK(is_weakly_found(claim, std::nullopt));
}

TEST_CASE("What lies in the scene gives way to what is evident and more of a puck to searches") {
  const Claim evident{
      .looks = {.quality = 0.7, .strength = 11}, .age_us = 5'001, .found = {.score = 0.75}};
  REQUIRE(is_evident(evident));
  Defence main{.lies_in_scene = true, .score = 0.64};
  CHECK(is_convincing(evident, main));
  main.score = 0.66;
  CHECK_FALSE(is_convincing(evident, main));
}

TEST_CASE("It gives way to what has clearly set off, while it looks good only to a whole ring") {
  Claim claim{.looks = {.speed_px_s = 500, .quality = 0.7, .strength = 90, .cover = 0.5},
              .age_us = 3'000,
              .leads = true};
  REQUIRE(is_clear_at_once(claim));
  Defence main{.lies_in_scene = true};
  CHECK(is_convincing(claim, main));
  main.looks = {.quality = 0.51, .strength = 7};
  CHECK_FALSE(is_convincing(claim, main));
  claim.looks.cover = 0.51;
  CHECK(is_convincing(claim, main));
}

TEST_CASE("It gives way to what moves as pucks do, but to nothing because that is stronger") {
  const Defence main{.looks = {.quality = 0.3, .strength = 5},
                     .lies_in_scene = true,
                     .since_good_us = 1'000'000,
                     .since_sound_us = 1'000'000};
  Claim claim{.looks = {.quality = 0.9, .strength = 200, .cover = 0.9},
              .age_us = 15'001,
              .found = {.score = 0.5}};
  CHECK_FALSE(is_convincing(claim, main));
  Defence elsewhere = main;
  elsewhere.lies_in_scene = false;
  CHECK(is_convincing(claim, elsewhere));
  claim.looks.speed_px_s = 301;
  CHECK(is_convincing(claim, main));
}

TEST_CASE("What is clear at once, or likely, was not found weakly, however far away") {
  CHECK_FALSE(is_weakly_found(kClear, std::nullopt));
  CHECK(is_weakly_found(without_at_once(kClear), std::nullopt));
  REQUIRE(is_likely(kLikely));
  CHECK_FALSE(is_weakly_found(kLikely, std::nullopt));
  CHECK(is_weakly_found(without_at_once(kLikely), std::nullopt));
}

TEST_CASE("The first need but be likely, whatever wall it has") {
  Claim likely = kLikely;
  likely.has_other_wall = true;
  CHECK(is_convincing_as_first(likely, 0));
  CHECK_FALSE(is_convincing_as_first(without_at_once(likely), 0));
}

TEST_CASE("Against a puck at rest only a high score is recognised, unless it is lost") {
  Defence main = kGoneBad;
  main.is_resting = true;
  CHECK(is_convincing(kRecognised, main));
  Claim moving = kRecognised;
  moving.found.score = 0.6;
  moving.looks.quality = 0.7;
  moving.looks.speed_px_s = 200;
  CHECK(is_convincing(moving, kGoneBad));
  CHECK_FALSE(is_convincing(moving, main));
  main.is_lost = true;
  CHECK(is_convincing(moving, main));
}

TEST_CASE("What moves by itself takes over from what never has") {
  Defence main = kStrongMain;
  main.looks.quality = 0.85;
  CHECK_FALSE(is_convincing(kLeading, main));
  main.is_proven = false;
  CHECK(outmoves(kLeading, main));
  CHECK(is_convincing(kLeading, main));
  main.looks.quality = 0.87;
  CHECK_FALSE(is_convincing(kLeading, main));
  Claim ring = kLeading;
  ring.looks.cover = 0.51;
  CHECK(is_convincing(ring, main));
  main.looks.quality = 0.97;
  CHECK_FALSE(is_convincing(ring, main));
}

TEST_CASE("What does not lead does not outmove what is good and has just been sound") {
  Defence main = kStrongMain;
  main.is_proven = false;
  main.looks.quality = 0.85;
  Claim claim = kLeading;
  claim.leads = false;
  CHECK_FALSE(outmoves(claim, main));
  main.since_sound_us = 20'000;
  CHECK(outmoves(claim, main));
  main.since_sound_us = 0;
  main.looks.strength = 6;
  CHECK(outmoves(claim, main));
}

TEST_CASE("What is no whole ring does not outmove what looks more like a puck to searches") {
  Defence main = kStrongMain;
  main.is_proven = false;
  main.knows_pucks = true;
  main.looks.quality = 0.8;
  main.score = 0.7;
  Claim claim = kLeading;
  claim.found.score = 0.59;
  CHECK_FALSE(outmoves(claim, main));
  claim.looks.cover = 0.51;
  CHECK(outmoves(claim, main));
  claim.looks.cover = 0.5;
  claim.found.score = 0.61;
  CHECK(outmoves(claim, main));
}

// Of another puck, and nothing more.
constexpr Claim kBetter{.looks = {.position = {500, 0},
                                  .speed_px_s = 301,
                                  .quality = 0.72,
                                  .strength = 151,
                                  .cover = 0.71},
                        .age_us = 15'001,
                        .found = {.score = 0.61},
                        .leads = true};
constexpr Defence kMallet{
    .looks = {.speed_px_s = 500, .quality = 0.7, .strength = 100, .cover = 0.7},
    .is_trusted = true,
    .is_proven = true,
    .knows_pucks = true,
    .is_witnessed = true,
    .score = 0.6};

TEST_CASE("What is more of a puck in every respect takes over from whatever is trusted") {
  CHECK(surpasses(kBetter, kMallet));
  CHECK(is_convincing(kBetter, kMallet));
  const auto still_does = [](auto change) {
    Claim claim = kBetter;
    change(claim);
    return is_convincing(claim, kMallet);
  };
  CHECK_FALSE(still_does([](Claim& claim) { claim.age_us = 15'000; }));
  CHECK_FALSE(still_does([](Claim& claim) { claim.leads = false; }));
  CHECK_FALSE(still_does([](Claim& claim) { claim.found.score = 0.6; }));
  CHECK_FALSE(still_does([](Claim& claim) { claim.looks.speed_px_s = 300; }));
  CHECK_FALSE(still_does([](Claim& claim) { claim.looks.quality = 0.7; }));
  CHECK_FALSE(still_does([](Claim& claim) { claim.looks.strength = 150; }));
  CHECK_FALSE(still_does([](Claim& claim) { claim.looks.cover = 0.7; }));
  CHECK_FALSE(still_does([](Claim& claim) { claim.looks.growth_px = 0.35; }));
  CHECK_FALSE(still_does([](Claim& claim) { claim.looks.growth_px = -0.35; }));
}

TEST_CASE("It may look a little less good than what is too small or too large for a puck") {
  Claim claim = kBetter;
  claim.looks.quality = 0.51;
  CHECK_FALSE(surpasses(claim, kMallet));
  for (const double growth_px : {-0.4, 0.4}) {
    Defence main = kMallet;
    main.looks.growth_px = growth_px;
    CHECK(surpasses(claim, main));
  }
}

TEST_CASE("It needs some strength, however little the track has") {
  Defence main = kMallet;
  main.looks.strength = 0;
  Claim claim = kBetter;
  claim.looks.strength = 61;
  CHECK(surpasses(claim, main));
  claim.looks.strength = 60;
  CHECK_FALSE(surpasses(claim, main));
}

TEST_CASE("What searches do not clearly see as a puck must be a fine ring") {
  Defence main = kMallet;
  main.score = 0.4;
  Claim claim = kBetter;
  claim.found.score = 0.46;
  CHECK(surpasses(claim, main));
  claim.found.score = 0.45;
  CHECK_FALSE(surpasses(claim, main));
  claim.looks.quality = 0.85;
  CHECK_FALSE(surpasses(claim, main));
  claim.looks.quality = 0.86;
  CHECK(surpasses(claim, main));
}

TEST_CASE(
    "What has half the events of a track that moves, on fewer sides, takes over only nearby") {
  Defence main{.looks = {.speed_px_s = 301, .quality = 0.66, .strength = 300, .cover = 0.8},
               .may_be_overtaken = true,
               .knows_pucks = true,
               .score = 0.69,
               .since_sound_us = 200'000};
  Claim claim{.looks = {.position = {500, 0},
                        .speed_px_s = 400,
                        .quality = 0.9,
                        .strength = 149,
                        .cover = 0.6},
              .age_us = 20'000,
              .found = {.score = 0.68},
              .leads = true};
  REQUIRE(outmoves(claim, main));
  CHECK_FALSE(is_convincing(claim, main));
  const auto takes_over_from = [&](auto change) {
    Defence changed = main;
    change(changed);
    return is_convincing(claim, changed);
  };
  CHECK(takes_over_from([](Defence& d) { d.knows_pucks = false; }));
  CHECK(takes_over_from([](Defence& d) { d.looks.speed_px_s = 300; }));
  CHECK(takes_over_from([](Defence& d) { d.looks.quality = 0.5; }));
  CHECK(takes_over_from([](Defence& d) { d.looks.strength = 298; }));
  CHECK(takes_over_from([](Defence& d) { d.looks.cover = 0.6; }));
  CHECK(takes_over_from([](Defence& d) { d.score = 0.68; }));
  claim.looks = {.position = {5, 0}, .quality = 0.8, .strength = 140, .cover = 0.6};
  main.looks.strength = 100;
  main.looks.cover = 0.8;
  claim.looks.strength = 131;
  CHECK(succeeds_nearby(claim, main));
  CHECK(is_convincing(claim, main));
}

TEST_CASE("A round mark, which turns with the head, displaces nothing that moves by itself") {
  const Claim mark{.looks = {.position = {500, 0},
                             .speed_px_s = 300,
                             .quality = 0.98,
                             .strength = 400,
                             .cover = 0.85},
                   .age_us = 15'001,
                   .found = {.score = 0.88}};
  Defence main{.looks = {.speed_px_s = 301, .quality = 0.8, .strength = 300, .cover = 0.8},
               .knows_pucks = true,
               .score = 0.6,
               .since_sound_us = 20'000};
  CHECK(unmasks(mark, main));
  CHECK(displaces_stranger(mark, main));
  main.since_sound_us = 19'999;
  CHECK_FALSE(unmasks(mark, main));
  CHECK_FALSE(displaces_stranger(mark, main));
  CHECK_FALSE(is_convincing(mark, main));
  Claim moving = mark;
  moving.looks.speed_px_s = 301;
  CHECK(unmasks(moving, main));
  main.looks.speed_px_s = 300;
  CHECK(unmasks(mark, main));
}

TEST_CASE("A conjecture must move by itself, unless the main track has not been sound for long") {
  Claim claim{.looks = {.quality = 0.7, .strength = 20},
              .age_us = 6'000,
              .found = {.score = 0.7, .is_conjecture = true}};
  Defence main = kBadMain;
  main.is_trusted = false;
  main.since_sound_us = 150'000;
  CHECK_FALSE(is_convincing(claim, main));
  main.since_sound_us = 150'001;
  CHECK(is_convincing(claim, main));
  main.since_sound_us = 0;
  claim.found.is_conjecture = false;
  CHECK(is_convincing(claim, main));
  claim = kMoving;
  claim.found.is_conjecture = true;
  CHECK(is_convincing(claim, main));
}

TEST_CASE("An evident puck takes over from a track that is not trusted or long unsound") {
  const Claim claim{.looks = {.position = {500, 0}, .quality = 0.7, .strength = 20},
                    .age_us = 6'000,
                    .found = {.score = 0.7}};
  Defence main = kStrongMain;
  main.looks.quality = 0.5;
  main.since_sound_us = 150'000;
  CHECK_FALSE(is_convincing(claim, main));
  main.since_sound_us = 150'001;
  CHECK(unmasks(claim, main));
  CHECK(is_convincing(claim, main));
  main.since_sound_us = 0;
  main.is_trusted = false;
  CHECK(is_convincing(claim, main));
  main.knows_pucks = true;
  main.score = 0.79;
  CHECK(unmasks(claim, main));
  main.score = 0.81;
  CHECK_FALSE(unmasks(claim, main));
}

TEST_CASE("A faint puck that is seen all around is unmasked by nothing but a whole ring") {
  Claim mallet{.looks = {.speed_px_s = 1'100, .quality = 0.81, .strength = 183, .cover = 0.3},
               .age_us = 22'000,
               .found = {.score = 0.42},
               .leads = true};
  REQUIRE(is_clear_at_once(mallet));
  const Defence faint{.looks = {.quality = 0.67, .strength = 88, .cover = 0.68},
                      .is_trusted = true,
                      .is_proven = true,
                      .knows_pucks = true,
                      .may_be_faint = true,
                      .score = 0.41,
                      .since_sound_us = 183'000};
  CHECK_FALSE(unmasks(mallet, faint));
  const auto unmasks_if = [&mallet, &faint](auto change) {
    Defence main = faint;
    change(main);
    return unmasks(mallet, main);
  };
  CHECK(unmasks_if([](Defence& main) { main.may_be_faint = false; }));
  CHECK(unmasks_if([](Defence& main) { main.knows_pucks = false; }));
  CHECK(unmasks_if([](Defence& main) { main.looks.quality = 0.5; }));
  CHECK(unmasks_if([](Defence& main) { main.looks.cover = 0.5; }));
  mallet.looks.cover = 0.51;
  CHECK(unmasks(mallet, faint));
  mallet.looks.cover = 0.3;
  mallet.found.score = 0.66;
  REQUIRE(is_evident(mallet));
  CHECK(unmasks(mallet, faint));
}

TEST_CASE("What has events on few sides, and is hardly seen, does not succeed a faint puck") {
  const Defence faint{.is_trusted = true, .knows_pucks = true, .may_be_faint = true};
  const Claim arm{.looks = {.quality = 0.66, .strength = 22, .cover = 0.34},
                  .age_us = 25'000,
                  .found = {.score = 0.44}};
  CHECK_FALSE(succeeds_nearby(arm, faint));
  Claim claim = arm;
  claim.looks.cover = 0.35;
  CHECK(succeeds_nearby(claim, faint));
  claim = arm;
  claim.found.score = 0.45;
  CHECK(succeeds_nearby(claim, faint));
  Defence main = faint;
  main.may_be_faint = false;
  CHECK(succeeds_nearby(arm, main));
  main = faint;
  main.knows_pucks = false;
  CHECK(succeeds_nearby(arm, main));
}

TEST_CASE("A track that is not trusted gives way to what looks better or twice as strong") {
  Claim claim{.looks = {.position = {500, 0}, .quality = 0.81, .strength = 30}, .age_us = 15'001};
  Defence main = kStrongMain;
  main.is_trusted = false;
  main.looks = {.quality = 0.8, .strength = 14};
  CHECK(displaces_stranger(claim, main));
  CHECK(is_convincing(claim, main));
  main.looks.strength = 15;
  CHECK_FALSE(is_convincing(claim, main));
  main.looks.quality = 0.68;
  CHECK(is_convincing(claim, main));
  main.is_trusted = true;
  CHECK_FALSE(is_convincing(claim, main));
}

TEST_CASE("A mallet, or what is too small, displaces no track, trusted or not") {
  Claim claim{.looks = {.position = {500, 0}, .quality = 0.9, .strength = 30}, .age_us = 15'001};
  Defence main = kStrongMain;
  main.is_trusted = false;
  main.looks = {.quality = 0.7, .strength = 14};
  CHECK(displaces_stranger(claim, main));
  claim.looks.growth_px = 0.45;
  CHECK_FALSE(displaces_stranger(claim, main));
  claim.looks.growth_px = -0.6;
  CHECK_FALSE(displaces_stranger(claim, main));
  claim.looks = {.position = {15, 0}, .growth_px = 0.44, .quality = 0.6, .strength = 20};
  main = kBadMain;
  main.since_good_us = 10'000;
  CHECK(succeeds_nearby(claim, main));
  claim.looks.growth_px = 0.45;
  CHECK_FALSE(succeeds_nearby(claim, main));
}

TEST_CASE("What searches see as more of a puck gives way only to what they see so, too") {
  Claim claim{.looks = {.position = {15, 0}, .quality = 0.9, .strength = 30},
              .age_us = 15'001,
              .found = {.score = 0.5}};
  Defence main = kBadMain;
  main.is_trusted = false;
  main.since_good_us = 10'000;
  main.score = 0.7;
  CHECK(displaces_stranger(claim, main));
  CHECK(succeeds_nearby(claim, main));
  main.knows_pucks = true;
  CHECK_FALSE(displaces_stranger(claim, main));
  CHECK_FALSE(succeeds_nearby(claim, main));
  claim.found.score = 0.61;
  CHECK(displaces_stranger(claim, main));
  CHECK(succeeds_nearby(claim, main));
}

TEST_CASE("A track that looks bad gives way to a better one within a reach that grows") {
  // 12 px, and 1.5 px more each millisecond without a good track.
  Claim claim{.looks = {.position = {15, 0}, .quality = 0.6, .strength = 20}, .age_us = 6'001};
  Defence main = kBadMain;
  main.since_good_us = 1'900;
  CHECK_FALSE(succeeds_nearby(claim, main));
  main.since_good_us = 2'100;
  CHECK(succeeds_nearby(claim, main));
  CHECK(is_convincing(claim, main));
  main.is_witnessed = true;
  CHECK_FALSE(is_convincing(claim, main));
}

TEST_CASE("The farther away, the better it must look, and never beyond 60 px") {
  Claim claim{.looks = {.position = {40, 0}, .quality = 0.69, .strength = 20}, .age_us = 6'001};
  Defence main = kBadMain;
  main.since_good_us = 1'000'000;
  CHECK_FALSE(succeeds_nearby(claim, main));
  claim.looks.quality = 0.71;
  CHECK(succeeds_nearby(claim, main));
  claim.looks = {.position = {61, 0}, .quality = 1, .strength = 20};
  CHECK_FALSE(succeeds_nearby(claim, main));
}

// Of a puck that something has just come over.
constexpr Defence kJustCovered{.looks = {.quality = 0, .strength = 9},
                               .is_trusted = true,
                               .is_proven = true,
                               .knows_pucks = true,
                               .was_covered = true,
                               .had_contrast = true,
                               .since_good_us = 36'000,
                               .since_sound_us = 119'999};
// An edge of the hand.
constexpr Claim kEdge{.looks = {.position = {8, 0}, .quality = 0.68, .strength = 52},
                      .age_us = 22'000,
                      .found = {.score = 0.45},
                      .leads = true};

TEST_CASE("What searches do not see as a puck does not succeed one that was just covered") {
  REQUIRE(succeeds_nearby(kEdge, kJustCovered));
  CHECK_FALSE(is_convincing(kEdge, kJustCovered));
  Claim seen = kEdge;
  seen.found.score = 0.46;
  CHECK(is_convincing(seen, kJustCovered));

  const auto still_convinces = [](auto&& change) {
    Defence main = kJustCovered;
    change(main);
    return is_convincing(kEdge, main);
  };
  CHECK(still_convinces([](Defence& main) { main.since_sound_us = 120'000; }));
  CHECK(still_convinces([](Defence& main) { main.was_covered = false; }));
  CHECK(still_convinces([](Defence& main) { main.had_contrast = false; }));
  CHECK(still_convinces([](Defence& main) { main.is_trusted = false; }));
  CHECK(still_convinces([](Defence& main) { main.is_proven = false; }));
  CHECK(still_convinces([](Defence& main) { main.knows_pucks = false; }));
}

// Recognised at 200 px from where the main track has left the image.
constexpr Claim kInside{.looks = {.position = {200, 100},
                                  .speed_px_s = 400,
                                  .quality = 0.8,
                                  .strength = 60,
                                  .cover = 0.6},
                        .age_us = 7'000,
                        .found = {.score = 0.5},
                        .leads = true};
constexpr Defence kLeft{.is_trusted = true,
                        .is_proven = true,
                        .knows_pucks = true,
                        .is_lost = true,
                        .had_contrast = true,
                        .way_back = WayBack::Reach{{0, 100}, 0.107},
                        .since_good_us = 50'000,
                        .since_sound_us = 50'000};

TEST_CASE("What has left the image is not believed to be farther than it can have come back") {
  REQUIRE(is_recognised(kInside, kLeft));
  CHECK(is_out_of_reach(kInside, kLeft));
  CHECK_FALSE(is_convincing(kInside, kLeft));
  Defence main = kLeft;
  main.way_back->gone_s = 0.108;
  CHECK_FALSE(is_out_of_reach(kInside, main));
  CHECK(is_convincing(kInside, main));
  main.way_back.reset();
  CHECK(is_convincing(kInside, main));
  // A faint puck is neither evident nor has many events.
  main = kLeft;
  main.had_contrast = false;
  CHECK(is_convincing(kInside, main));
}

TEST_CASE("Out of reach only the evident is believed, or a fast whole ring of very many events") {
  Claim evident = kInside;
  evident.found.score = 0.66;
  CHECK_FALSE(is_out_of_reach(evident, kLeft));

  Claim hit = kInside;
  hit.looks.strength = 301;
  hit.looks.speed_px_s = 700;
  CHECK_FALSE(is_out_of_reach(hit, kLeft));
  const auto is_refused = [&](auto&& change) {
    Claim claim = hit;
    change(claim.looks);
    return is_out_of_reach(claim, kLeft);
  };
  CHECK(is_refused([](TrackLooks& looks) { looks.strength = 300; }));
  CHECK(is_refused([](TrackLooks& looks) { looks.cover = 0.5; }));
  CHECK(is_refused([](TrackLooks& looks) { looks.turning_px_s = 700; }));
  CHECK(is_refused([](TrackLooks& looks) { looks.growth_px = 0.35; }));
  // A mallet that moves inside the image has not been fast enough to come from there.
  CHECK(is_refused([](TrackLooks& looks) { looks.speed_px_s = 600; }));
}

TEST_CASE("Nor does it by another rule, unless it is clear at once") {
  Claim mallet = kLeading;
  mallet.looks.position = {500, 0};
  Defence main = kJustCovered;
  main.may_be_overtaken = true;
  REQUIRE(outmoves(mallet, main));
  CHECK_FALSE(is_convincing(mallet, main));
  Claim clear = mallet;
  clear.looks.quality = 0.86;
  clear.looks.strength = 61;
  REQUIRE(is_clear_at_once(clear));
  CHECK(is_convincing(clear, main));
}

TEST_CASE("From a track of some quality it takes over only if it is stronger and leads") {
  Claim claim{.looks = {.quality = 0.7, .strength = 27}, .age_us = 6'001, .leads = true};
  Defence main = kBadMain;
  main.looks = {.quality = 0.5, .strength = 20};
  CHECK(succeeds_nearby(claim, main));
  claim.leads = false;
  CHECK_FALSE(succeeds_nearby(claim, main));
  claim.leads = true;
  claim.looks.strength = 26;
  CHECK_FALSE(succeeds_nearby(claim, main));
}

TEST_CASE("The first is waited for 150 ms before less than the evident is believed") {
  Claim claim{.looks = {.growth_px = 0.34, .quality = 0.81, .strength = 31, .cover = 0.51},
              .age_us = 20'001};
  CHECK_FALSE(is_convincing_as_first(claim, 150'000));
  CHECK(is_convincing_as_first(claim, 150'001));
  claim.looks.cover = 0.5;
  CHECK_FALSE(is_convincing_as_first(claim, 150'001));
  claim.looks.cover = 0.51;
  claim.looks.growth_px = 0.35;
  CHECK_FALSE(is_convincing_as_first(claim, 150'001));
  claim.found.score = 0.7;
  CHECK(is_convincing_as_first(claim, 0));
  CHECK(is_convincing_as_first(kMoving, 0));
  Claim mallet = kMoving;
  mallet.looks.growth_px = 0.35;
  CHECK(moves_by_itself(mallet));
  CHECK_FALSE(is_convincing_as_first(mallet, 0));
  Claim line = kMoving;
  line.looks.slide = 1.5;
  CHECK(is_convincing_as_first(line, 0));
  line.looks.slide = 1.6;
  CHECK(moves_by_itself(line));
  CHECK_FALSE(is_convincing_as_first(line, 0));
  Claim evident{
      .looks = {.quality = 0.9, .strength = 200}, .age_us = 8'000, .found = {.score = 0.8}};
  CHECK(is_convincing_as_first(evident, 0));
  evident.has_other_wall = true;
  CHECK_FALSE(is_convincing_as_first(evident, 150'000));
  CHECK(is_convincing_as_first(evident, 150'001));
}

TEST_CASE("The first may be a printed puck, but for a while not with another wall") {
  CHECK(is_convincing_as_first(kPrintedAtRest, 0));
  CHECK(is_weakly_found(kPrintedAtRest, std::nullopt));
  Claim claim = kPrintedAtRest;
  claim.has_other_wall = true;
  CHECK_FALSE(is_convincing_as_first(claim, 150'000));
  CHECK(is_convincing_as_first(claim, 150'001));
}

Claim while_turning(Claim claim) {
  claim.context.head_may_turn = true;
  return claim;
}

TEST_CASE("While the head may turn the first is not adrift, for 600 ms") {
  for (Claim claim : {kEvident, kLikely, kPrintedAtRest, kAwaited}) {
    claim = while_turning(claim);
    claim.own_speed_px_s = 150;
    CHECK(is_convincing_as_first(claim, 150'001));
    claim.own_speed_px_s = 151;
    REQUIRE(is_adrift(claim));
    CHECK_FALSE(is_convincing_as_first(claim, 600'000));
    CHECK(is_convincing_as_first(claim, 600'001));
    claim.context.head_may_turn = false;
    CHECK(is_convincing_as_first(claim, 150'001));
  }
}

TEST_CASE("While the head may turn the first does not slide along an edge, for 600 ms") {
  for (Claim claim : {kEvident, kLikely, kPrintedAtRest, kAwaited}) {
    claim.looks.slide = 1.6;
    CHECK(is_convincing_as_first(claim, 150'001));
    claim = while_turning(claim);
    CHECK_FALSE(is_convincing_as_first(claim, 600'000));
    CHECK(is_convincing_as_first(claim, 600'001));
    claim.looks.slide = 1.5;
    CHECK(is_convincing_as_first(claim, 150'001));
  }
}

TEST_CASE("While the head may turn what is very strong may seem to slide, or be half a ring") {
  Claim claim = while_turning(kEvident);
  claim.looks.slide = 1.6;
  claim.looks.strength = 80;
  CHECK_FALSE(is_convincing_as_first(claim, 0));
  claim.looks.strength = 81;
  CHECK(is_convincing_as_first(claim, 0));
  claim = while_turning(kMoving);
  claim.looks.strength = 80;
  CHECK_FALSE(is_convincing_as_first(claim, 0));
  claim.looks.strength = 81;
  CHECK(is_convincing_as_first(claim, 0));
}

TEST_CASE(
    "While the head may turn what has something in its middle is not likely, but for a print") {
  Claim claim = while_turning(kLikely);
  claim.looks.inside_events = 12;
  CHECK(is_convincing_as_first(claim, 0));
  claim.looks.inside_events = 13;
  CHECK_FALSE(is_convincing_as_first(claim, 0));
  claim.context.head_may_turn = false;
  CHECK(is_convincing_as_first(claim, 0));
  claim = while_turning(kPrintedAtRest);
  REQUIRE(claim.looks.is_covered());
  CHECK(is_convincing_as_first(claim, 0));
}

TEST_CASE("While the head may turn the first that moves by itself is a whole ring") {
  Claim claim = while_turning(kMoving);
  claim.looks.cover = 0.5;
  CHECK_FALSE(is_convincing_as_first(claim, 0));
  claim.looks.cover = 0.51;
  CHECK(is_convincing_as_first(claim, 0));
}

TEST_CASE("Where it is known how the head turns only a whole or very strong ring displaces") {
  Claim claim{.looks = {.position = {500, 0}, .quality = 0.9, .strength = 80, .cover = 0.5},
              .age_us = 15'001};
  const Defence main{.looks = {.quality = 0.7, .strength = 14}};
  CHECK(displaces_stranger(claim, main));
  for (const double own_px_s : {0.0, 1'000.0}) {
    claim.own_speed_px_s = own_px_s;
    claim.looks.cover = 0.5;
    CHECK_FALSE(displaces_stranger(claim, main));
    claim.looks.cover = 0.51;
    CHECK(displaces_stranger(claim, main));
  }
  claim.looks.cover = 0.5;
  claim.looks.strength = 81;
  CHECK(displaces_stranger(claim, main));
}

TEST_CASE("What moves by itself takes over from a proven track that has gone bad") {
  Defence main{.looks = {.quality = 0.4},
               .is_trusted = true,
               .is_proven = true,
               .may_be_overtaken = true,
               .since_good_us = 20'000};
  CHECK_FALSE(is_convincing(kMoving, main));
  main.since_good_us = 20'001;
  CHECK(is_convincing(kMoving, main));
  main.may_be_overtaken = false;
  CHECK_FALSE(is_convincing(kMoving, main));
  main.may_be_overtaken = true;
  Claim slow = kMoving;
  slow.looks.speed_px_s = 300;
  CHECK_FALSE(is_convincing(slow, main));
  main.looks.quality = kMoving.looks.quality + 0.1;
  CHECK_FALSE(is_convincing(kMoving, main));
}

TEST_CASE("What was found near the track, is evident or moves by itself was not found weakly") {
  const Claim claim{.looks = {.position = {60, 0}}};
  CHECK(is_weakly_found(claim, std::nullopt));
  CHECK(is_weakly_found(claim, TrackLooks{}));
  CHECK_FALSE(is_weakly_found(claim, TrackLooks{.position = {1, 0}}));
  CHECK_FALSE(is_weakly_found(kMoving, std::nullopt));
}

}  // namespace
}  // namespace puck
