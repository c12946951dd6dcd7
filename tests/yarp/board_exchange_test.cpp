#include "common/yarp/board_exchange.h"

#include <array>

#include <doctest/doctest.h>

namespace puck {
namespace {

JointAngles at(double deg) { return JointAngles(std::array{deg}); }

constexpr std::int64_t kSilentUs = 100'000;

}  // namespace

TEST_CASE("the newest set-point wins, and those it replaced are counted") {
  BoardExchange exchange(kSilentUs);
  exchange.begin_connection({at(1), 1000});
  REQUIRE(exchange.reading());
  CHECK(exchange.give_set_point(at(1)));
  CHECK(exchange.give_set_point(at(2)));
  CHECK((*exchange.take_set_point())[0] == 2);
  CHECK(!exchange.take_set_point());
  CHECK(exchange.counters(1000).set_points_replaced == 1);
}

TEST_CASE("a set-point is dropped until the loop has read the encoders of this connection") {
  BoardExchange exchange(kSilentUs);
  CHECK(!exchange.give_set_point(at(1)));
  exchange.begin_connection({at(1), 1000});
  CHECK(!exchange.give_set_point(at(1)));
  CHECK(exchange.reading());
  CHECK(exchange.give_set_point(at(1)));

  // However short the interruption was.
  exchange.lose_connection("it broke");
  exchange.begin_connection({at(5), 2000});
  CHECK(!exchange.take_set_point());
  CHECK(!exchange.give_set_point(at(1)));
  CHECK(exchange.reading());
  CHECK(!exchange.give_set_point(at(1)));
  CHECK(exchange.fault(2000) == "it broke");
  CHECK(exchange.fault(2000).empty());
  CHECK(exchange.give_set_point(at(5)));
  CHECK(exchange.counters(2000).set_points_unheard == 4);
}

TEST_CASE("a board that is not there yet is no fault, and one that goes away is") {
  BoardExchange exchange(kSilentUs);
  CHECK(!exchange.reading());
  CHECK(exchange.fault(0).empty());
  exchange.lose_connection("not there yet");
  CHECK(exchange.fault(0).empty());
  CHECK(exchange.awaited() == "not there yet");
  CHECK(!exchange.reading());
  exchange.begin_connection({at(1), 1000});
  CHECK(exchange.awaited().empty());
  exchange.lose_connection("nobody there");
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
  // One that was given before the loop was told is dropped as well.
  CHECK(exchange.give_set_point(at(1)));
  exchange.refuse_set_point("it is not finite");
  CHECK(!exchange.take_set_point());
  CHECK(!exchange.give_set_point(at(1)));
  CHECK(exchange.fault(1000) == "it is not finite");
  CHECK(exchange.fault(1000).empty());
  CHECK(exchange.give_set_point(at(1)));
}

TEST_CASE("encoders that have not come for long are a fault even if nobody says so") {
  BoardExchange exchange(kSilentUs);
  exchange.begin_connection({at(1), 1000});
  CHECK(exchange.fault(201'000).empty());
  CHECK(exchange.fault(201'001) == "no encoders for 200 ms");
}

}  // namespace puck
