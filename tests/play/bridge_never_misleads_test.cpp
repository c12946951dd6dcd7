#include <cmath>
#include <cstdint>
#include <map>

#include <doctest/doctest.h>

#include "tests/play/bridge_bench.h"
#include "tests/support/sanitizers.h"
#include "tests/support/wild_values.h"

namespace puck {
namespace {

constexpr int kSteps = kIsSanitized ? 20'000 : 500'000;
constexpr std::int64_t kMaxAgeUs = 100'000;

// Modifies estimates in every way that a bridge must detect or tolerate.
class Mischief : public WildValues {
 public:
  using WildValues::WildValues;

  /// Returns whether the estimate must now be refused, after any earlier ones.
  bool spoil(PublishedEstimate& e) {
    switch (below(14)) {
      case 0:
        e.position->x = wild_number(2000);
        return !std::isfinite(e.position->x) || std::abs(e.position->x) > 1e6;
      case 1:
        e.position->y = wild_number(2000);
        return !std::isfinite(e.position->y) || e.position->y < -100;
      case 2:
        e.velocity.x = wild_number(2000);
        return !std::isfinite(e.velocity.x) || std::abs(e.velocity.x) > 1e6;
      case 3:
        e.covariance[5 * below(4)] = wild_number(2000);
        return std::isnan(e.covariance[0] + e.covariance[5] + e.covariance[10] + e.covariance[15]);
      case 4:
        e.covariance[1] = e.covariance[4] = 5;  // more than the variances allow
        return true;
      case 5:
        e.state = static_cast<TrackState>(below(3));
        return e.state != TrackState::kTracking;
      case 6:
        e.position.reset();
        return true;
      case 7:
        *e.event_utime -= 100'001 + below(1'000'000);
        return true;
      case 8:
        e.event_utime = wild_integer();
        if (e.event_utime == 0) e.event_utime.reset();  // not known
        return e.event_utime.has_value();
      case 9:
        e.utime += (chance(0.5) ? 1 : -1) * (200'001 + below(1'000'000));
        return true;
      case 10:
        e.session = wild_integer();
        return false;
      case 11:
        e.seq -= 1 + below(50);  // late, unless what lies between was refused
        return false;
      case 12:
        e.newest_event.us =
            chance(0.5) ? wild_integer() : e.newest_event.us + below(10'000'000) - 5'000'000;
        return false;
      default:
        e.position = Pixel{between(0, 640), between(100, 480)};
        return false;
    }
  }
};

struct Heard {
  Heard(std::int64_t publisher, std::int64_t heard_us, std::int64_t happened_us)
      : session(publisher), at_us(heard_us), event_us(happened_us) {}
  std::int64_t session = 0;
  std::int64_t at_us = 0;     // CLOCK_MONOTONIC
  std::int64_t event_us = 0;  // by the same
};

TEST_CASE("Whatever arrives, every command is based on a good, live estimate") {
  int commands = 0;
  int refused = 0;
  int blind_steps = 0;
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    BridgeBench bench;
    Mischief mischief(seed);
    const PuckMotion motion(TableGeometry{});
    PuckTrack puck{{{1.5, 0.1}, {-1, 0.3}}, {}};
    std::map<std::int64_t, Heard> good;  // by seq
    std::int64_t arm_us = -1'000'000;
    std::int64_t head_seq = 0;
    bool head_is_home = true;
    double estimate_rate = 1;
    double spoilt = 0;
    for (int i = 0; i < kSteps / 5; ++i) {
      if (i % 200 == 0) {
        estimate_rate = mischief.chance(0.2) ? 0.01 : 0.8;
        spoilt = mischief.chance(0.5) ? 0.5 : 0.02;
      }
      if (i % 997 == 0) puck.state.velocity = {mischief.between(-8, 8), mischief.between(-5, 5)};
      bench.pass(mischief.chance(0.01) ? mischief.below(120'000) : mischief.below(2000));
      puck = {motion.advance(puck, 0.001).track.state, {}};
      if (i / 500 % 4 != 3 && mischief.chance(0.3)) {
        bench.see_arm();
        arm_us = bench.now.monotonic_us;
      }
      if (mischief.chance(0.002)) {
        HeadState head;
        head.session = 5001;
        head.seq = ++head_seq;
        head.yaw_deg = mischief.chance(0.5) ? 3 : 0;
        head_is_home = head.yaw_deg == 0;
        bench.bridge.hear(head, bench.now);
      }
      if (mischief.chance(estimate_rate)) {
        PublishedEstimate e = bench.estimate(puck.state);
        const bool must_be_refused = mischief.chance(spoilt) && mischief.spoil(e);
        bench.bridge.hear(e, bench.now, bench.sender);
        if (must_be_refused) {
          ++refused;
        } else {
          const std::int64_t age_us = e.event_utime ? bench.sender_utime() - *e.event_utime : 0;
          good.try_emplace(e.seq, e.session, bench.now.monotonic_us,
                           bench.now.monotonic_us - age_us);
        }
      }

      bench.command.reset();
      bench.take();
      if (!head_is_home) ++blind_steps;
      if (!bench.command) continue;
      ++commands;
      const ArmCommand& command = *bench.command;
      REQUIRE(std::abs(command.target_m) <= 0.3);
      REQUIRE(std::abs(command.target_normalised) <= 1);
      REQUIRE(command.arrive_in_us >= 0);
      REQUIRE(command.valid_for_us <= 100'000);
      REQUIRE(head_is_home);
      REQUIRE(bench.now.monotonic_us - arm_us <= 500'000);
      const auto basis = good.find(command.estimate.seq);
      REQUIRE(basis != good.end());
      REQUIRE(command.estimate.session == basis->second.session);
      REQUIRE(bench.now.monotonic_us - basis->second.at_us <= kMaxAgeUs);
      REQUIRE(bench.now.monotonic_us - basis->second.event_us <= kMaxAgeUs);
    }
  }
  // The test must have covered its subject.
  CHECK(commands > kSteps / 50);
  CHECK(refused > kSteps / 50);
  CHECK(blind_steps > kSteps / 50);
  MESSAGE(commands, " commands, ", refused, " estimates that had to be refused");
}

}  // namespace
}  // namespace puck
