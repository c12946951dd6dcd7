#include "common/yarp/board_exchange.h"

#include <array>

#include <doctest/doctest.h>

namespace puck {
namespace {

JointAngles at(double deg) { return JointAngles(std::array{deg}); }

constexpr std::int64_t kSilentUs = 100'000;

}  // namespace

TEST_CASE("the newest set-point wins, and replaced ones are counted") {
  BoardExchange exchange(kSilentUs);
  exchange.begin_connection({at(1), 1000});
  REQUIRE(exchange.reading());
  CHECK(exchange.give_set_point(at(1), 1000));
  CHECK(exchange.give_set_point(at(2), 1000));
  CHECK((*exchange.take_set_point(1000))[0] == 2);
  CHECK(!exchange.take_set_point(1000));
  CHECK(exchange.counters(1000).set_points_replaced == 1);
}

TEST_CASE("a set-point is dropped until the loop has read the encoders of this connection") {
  BoardExchange exchange(kSilentUs);
  CHECK(!exchange.give_set_point(at(1), 1000));
  exchange.begin_connection({at(1), 1000});
  CHECK(!exchange.give_set_point(at(1), 1000));
  CHECK(exchange.reading());
  CHECK(exchange.give_set_point(at(1), 1000));

  // After an interruption of any length.
  exchange.lose_connection(YarpError("it broke"));
  exchange.begin_connection({at(5), 2000});
  CHECK(!exchange.take_set_point(1000));
  CHECK(!exchange.give_set_point(at(1), 1000));
  CHECK(exchange.reading());
  CHECK(!exchange.give_set_point(at(1), 1000));
  CHECK(exchange.fault(2000) == "it broke");
  CHECK(exchange.fault(2000).empty());
  CHECK(exchange.give_set_point(at(5), 1000));
  CHECK(exchange.counters(2000).set_points_unheard == 4);
}

TEST_CASE("an absent board is no fault, and one that disconnects is") {
  BoardExchange exchange(kSilentUs);
  CHECK(!exchange.reading());
  CHECK(exchange.fault(0).empty());
  exchange.lose_connection(YarpError("not there yet"));
  CHECK(exchange.fault(0).empty());
  CHECK(exchange.awaited() == "not there yet");
  CHECK(!exchange.reading());
  exchange.begin_connection({at(1), 1000});
  CHECK(exchange.awaited().empty());
  exchange.lose_connection(YarpError("nobody there"));
  CHECK(exchange.awaited().empty());
  CHECK(exchange.fault(0) == "nobody there");
  CHECK(exchange.fault(0) == "nobody there");
  CHECK(!exchange.reading());
  CHECK(!exchange.counters(0).encoder_age_us);
  exchange.begin_connection({at(1), 1000});
  CHECK(exchange.fault(1000).empty());
  CHECK(exchange.counters(1500).encoder_age_us == 500);
  CHECK(exchange.counters(0).failures == 2);
}

TEST_CASE("a refused set-point is a fault, once") {
  BoardExchange exchange(kSilentUs);
  exchange.begin_connection({at(1), 1000});
  exchange.reading();
  // A set-point from before the loop knew of it is dropped as well.
  CHECK(exchange.give_set_point(at(1), 1000));
  exchange.refuse_set_point("it is not finite");
  CHECK(!exchange.take_set_point(1000));
  CHECK(!exchange.give_set_point(at(1), 1000));
  CHECK(exchange.fault(1000) == "it is not finite");
  CHECK(exchange.fault(1000).empty());
  CHECK(exchange.give_set_point(at(1), 1000));
}

TEST_CASE("a permanent error before the first connection is a fault, until it is repaired") {
  BoardExchange exchange(kSilentUs);
  exchange.lose_connection(YarpError("it does not fit", YarpError::Kind::kNeedsPerson));
  CHECK(exchange.fault(0) == "it does not fit");
  CHECK(exchange.fault(0) == "it does not fit");
  CHECK(exchange.awaited().empty());
  exchange.lose_connection(YarpError("it is off"));
  CHECK(exchange.fault(0).empty());
  CHECK(exchange.awaited() == "it is off");
  exchange.begin_connection({at(1), 1000});
  CHECK(exchange.fault(1000).empty());
}

TEST_CASE("unready joints are waited for before the arm takes them, and a fault afterwards") {
  const YarpError not_ready("it is being calibrated", YarpError::Kind::kNotReady);
  BoardExchange exchange(kSilentUs);
  exchange.begin_connection({at(1), 1000});
  CHECK(!exchange.holds());
  exchange.lose_connection(not_ready);
  CHECK(exchange.fault(0).empty());
  CHECK(exchange.awaited() == "it is being calibrated");
  exchange.begin_connection({at(1), 1000});
  exchange.put_hold();
  CHECK(exchange.holds());
  exchange.lose_connection(not_ready);
  CHECK(!exchange.holds());
  CHECK(exchange.fault(0) == "it is being calibrated");
  CHECK(exchange.awaited().empty());
}

TEST_CASE("a set-point that has waited for more than 100 ms is not sent") {
  BoardExchange exchange(kSilentUs);
  exchange.begin_connection({at(1), 1000});
  exchange.reading();
  CHECK(exchange.give_set_point(at(1), 5000));
  CHECK(exchange.newest_set_point(105'000));
  CHECK(exchange.take_set_point(105'000));
  CHECK(exchange.give_set_point(at(1), 5000));
  CHECK(!exchange.newest_set_point(105'001));
  CHECK(!exchange.take_set_point(105'001));
  CHECK(exchange.counters(0).set_points_expired == 1);
  CHECK(exchange.give_set_point(at(2), 105'001));
  CHECK((*exchange.take_set_point(105'002))[0] == 2);
}

TEST_CASE("a withdrawn set-point is not sent, at any stage of waiting") {
  BoardExchange exchange(kSilentUs);
  exchange.begin_connection({at(1), 1000});
  exchange.reading();
  exchange.withdraw_set_point();
  CHECK(exchange.give_set_point(at(1), 1000));
  exchange.withdraw_set_point();
  exchange.withdraw_set_point();
  CHECK(!exchange.take_set_point(1000));
  CHECK(exchange.give_set_point(at(1), 1000));
  CHECK(exchange.newest_set_point(1000));
  exchange.withdraw_set_point();
  CHECK(!exchange.newest_set_point(1000));
  CHECK(exchange.counters(0).set_points_withdrawn == 2);
  CHECK(exchange.give_set_point(at(1), 1000));
  exchange.withdraw_set_point();
  CHECK(exchange.give_set_point(at(3), 1000));
  CHECK((*exchange.take_set_point(1000))[0] == 3);
  CHECK(exchange.counters(0).set_points_replaced == 0);
}

TEST_CASE("encoders missing for long are a fault, even without an error message") {
  BoardExchange exchange(kSilentUs);
  exchange.begin_connection({at(1), 1000});
  CHECK(exchange.fault(201'000).empty());
  CHECK(exchange.fault(201'001) == "no encoders for 200 ms");
}

}  // namespace puck
