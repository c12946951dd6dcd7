#include "common/baselines/event_window.h"

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("a window holds the newest events, newest first") {
  EventWindow window(3);
  CHECK(window.size() == 0);
  for (int i = 1; i <= 5; ++i) window.push({static_cast<double>(i), 0});
  REQUIRE(window.size() == 3);
  CHECK(window[0].x == 5);
  CHECK(window[1].x == 4);
  CHECK(window[2].x == 3);
}

TEST_CASE("a shortened window drops its oldest events, and grows again") {
  EventWindow window(4);
  for (int i = 1; i <= 4; ++i) window.push({static_cast<double>(i), 0});
  window.keep_newest(9);
  CHECK(window.size() == 4);
  window.keep_newest(2);
  REQUIRE(window.size() == 2);
  CHECK(window[1].x == 3);
  window.push({5, 0});
  REQUIRE(window.size() == 3);
  CHECK(window[0].x == 5);
  CHECK(window[2].x == 3);
}

}  // namespace puck
