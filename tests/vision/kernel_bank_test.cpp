#include "common/vision/correlation/kernel_bank.h"

#include <limits>
#include <stdexcept>

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("a bank takes the next odd size") {
  const KernelBank bank(KernelBankParams{});
  CHECK(bank.nearest({29.0, 19.0}).width() == 29 + 4);
  CHECK(bank.nearest({28.9, 18.1}).width() == 29 + 4);
  CHECK(bank.nearest({28.9, 18.1}).height() == 19 + 4);
  CHECK(bank.nearest({30.0, 19.9}).width() == 31 + 4);
}

TEST_CASE("sizes beyond the bank, even infinite ones and NaN, are clamped to it") {
  const KernelBank bank(KernelBankParams{});
  CHECK(bank.nearest({1e9, 1e9}).width() == 51 + 4);
  CHECK(bank.nearest({-5, 0}).height() == 9 + 4);
  CHECK(bank.nearest({std::numeric_limits<double>::quiet_NaN(), 20}).width() == 9 + 4);
  CHECK(bank.nearest({std::numeric_limits<double>::infinity(), 20}).width() == 51 + 4);
}

TEST_CASE("a bank of even or disordered sizes is refused") {
  KernelBankParams params;
  params.smallest_px = 10;
  CHECK_THROWS_AS(KernelBank{params}, std::invalid_argument);
  params.smallest_px = 53;
  CHECK_THROWS_AS(KernelBank{params}, std::invalid_argument);
}

}  // namespace puck
