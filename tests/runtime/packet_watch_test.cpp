#include "common/runtime/packet_watch.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

using std::chrono::microseconds;

PacketWatch::Clock::time_point at(int time_us) {
  return PacketWatch::Clock::time_point(microseconds(time_us));
}

}  // namespace

TEST_CASE("a packet waits until an estimate includes its last event") {
  PacketWatch watch;
  LatencyHistogram waits;
  watch.expect({1000}, at(50));
  watch.answer({999}, at(60), waits);
  CHECK(waits.summary().samples == 0);
  watch.answer({1000}, at(62), waits);
  CHECK(waits.summary().samples == 1);
  CHECK(waits.summary().max_us == 12);
  watch.answer({1000}, at(90), waits);
  CHECK(waits.summary().samples == 1);
}

TEST_CASE("a late estimate ends the waits of all packets that it includes") {
  PacketWatch watch;
  LatencyHistogram waits;
  watch.expect({1000}, at(1));
  watch.expect({2000}, at(2));
  watch.expect({3000}, at(3));
  watch.answer({2500}, at(10), waits);
  CHECK(waits.summary().samples == 2);
  CHECK(waits.summary().max_us == 9);
  watch.answer({3000}, at(11), waits);
  CHECK(waits.summary().samples == 3);
}

TEST_CASE("unanswered packets have limited room, and can be dropped") {
  PacketWatch watch;
  LatencyHistogram waits;
  for (int i = 0; i < 100'000; ++i) watch.expect({i}, at(i));
  watch.clear();
  watch.expect({5}, at(100'000));
  watch.answer({100'000}, at(100'001), waits);
  CHECK(waits.summary().samples == 1);
  CHECK(waits.summary().max_us == 1);
}

}  // namespace puck
