#include <doctest/doctest.h>

#include "tools/play/save_figures.h"

namespace puck {

TEST_CASE("Wilson's interval equals published tables") {
  // Newcombe 1998, Statistics in Medicine 17, table I: 81 of 263, 15 of 148, 0 of 20, 1 of 29.
  const Interval many = wilson_interval(81, 263);
  CHECK(many.low == doctest::Approx(0.2553).epsilon(1e-3));
  CHECK(many.high == doctest::Approx(0.3662).epsilon(1e-3));
  const Interval few = wilson_interval(15, 148);
  CHECK(few.low == doctest::Approx(0.0624).epsilon(2e-3));
  CHECK(few.high == doctest::Approx(0.1605).epsilon(1e-3));
  const Interval none = wilson_interval(0, 20);
  CHECK(none.low == 0);
  CHECK(none.high == doctest::Approx(0.1611).epsilon(1e-3));
  const Interval one = wilson_interval(1, 29);
  CHECK(one.low == doctest::Approx(0.0061).epsilon(1e-2));
  CHECK(one.high == doctest::Approx(0.1718).epsilon(1e-3));
}

TEST_CASE("Without shots every share is possible; with all saved the bound stays below 1") {
  CHECK(wilson_interval(0, 0).low == 0);
  CHECK(wilson_interval(0, 0).high == 1);
  CHECK(wilson_interval(20, 20).high == 1);
  CHECK(wilson_interval(20, 20).low == doctest::Approx(1 - 0.1611).epsilon(1e-3));
}

}  // namespace puck
