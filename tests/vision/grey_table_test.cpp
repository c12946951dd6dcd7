#include "common/vision/surface/grey_table.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/simd_targets.h"

namespace puck {

TEST_CASE("every instruction set gives the grey values of the table, for every decay") {
  with_each_simd_target([](const std::string& name) {
    CAPTURE(name);
    for (const double decay : {0.01, 0.3, 0.72, 0.786, 0.8963, 0.95, 0.97, 0.99, 0.999}) {
      CAPTURE(decay);
      for (const ErosRounding rounding :
           {ErosRounding::kNearest, ErosRounding::kTruncateEachStep}) {
        const GreyTable grey(eros_greys(decay, rounding));
        // All counts, at every place in a vector, and a remainder shorter than one.
        std::vector<std::uint8_t> fast(256 * 3 + 5);
        std::iota(fast.begin(), fast.end(), std::uint8_t{0});
        std::vector<std::uint8_t> plain = fast;
        grey.apply(fast);
        for (std::uint8_t& count : plain) count = grey(count);
        REQUIRE(fast == plain);
      }
    }
  });
}

TEST_CASE("grey values are 255 times the decay to the number of events, and 0 without an event") {
  const GreyTable grey(eros_greys(0.9, ErosRounding::kNearest));
  for (int n = 0; n < 255; ++n) {
    REQUIRE(std::abs(grey(static_cast<std::uint8_t>(255 - n)) - 255 * std::pow(0.9, n)) <= 0.5);
  }
  CHECK(grey(0) == 0);
}

}  // namespace puck
