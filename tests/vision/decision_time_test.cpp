#include "common/vision/decision_time.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

TEST_CASE("An event at the time of a decision belongs to it, a later one comes after it") {
  CHECK(decision_before(1, 500) == 0);
  CHECK(decision_before(500, 500) == 0);
  CHECK(decision_before(501, 500) == 500);
  CHECK(decision_before(1'000, 500) == 500);
  CHECK(decision_before(1'234, 500) == 1'000);
}

}  // namespace
}  // namespace puck
