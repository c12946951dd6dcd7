#include "common/evaluation/quantile.h"

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("a quantile is one of the values, and the requested share does not exceed it") {
  const std::vector<int> sorted{1, 2, 3, 4};
  CHECK(quantile(sorted, 0) == 1);
  CHECK(quantile(sorted, 0.25) == 1);
  CHECK(quantile(sorted, 0.26) == 2);
  CHECK(quantile(sorted, 0.5) == 2);
  CHECK(quantile(sorted, 0.99) == 4);
  CHECK(quantile(sorted, 1) == 4);
  CHECK(quantile(std::vector<double>{7.5}, 0.5) == 7.5);
}

}  // namespace puck
