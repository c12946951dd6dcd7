#pragma once

#include <array>
#include <cstddef>

namespace puck {

/// N × N, row-major.
template <std::size_t N>
using SquareMatrix = std::array<double, N * N>;

/// N of a matrix with this many elements.
constexpr std::size_t side_of(std::size_t elements) {
  std::size_t side = 0;
  while (side * side < elements) ++side;
  return side;
}

template <std::size_t Elements>
constexpr std::array<double, Elements> product(const std::array<double, Elements>& a,
                                               const std::array<double, Elements>& b) {
  constexpr std::size_t kSide = side_of(Elements);
  static_assert(kSide * kSide == Elements);
  std::array<double, Elements> result{};
  for (std::size_t row = 0; row < kSide; ++row) {
    for (std::size_t column = 0; column < kSide; ++column) {
      for (std::size_t k = 0; k < kSide; ++k) {
        result[kSide * row + column] += a[kSide * row + k] * b[kSide * k + column];
      }
    }
  }
  return result;
}

template <std::size_t Elements>
constexpr std::array<double, Elements> transposed(const std::array<double, Elements>& a) {
  constexpr std::size_t kSide = side_of(Elements);
  static_assert(kSide * kSide == Elements);
  std::array<double, Elements> result{};
  for (std::size_t row = 0; row < kSide; ++row) {
    for (std::size_t column = 0; column < kSide; ++column) {
      result[kSide * column + row] = a[kSide * row + column];
    }
  }
  return result;
}

template <std::size_t Elements>
constexpr std::array<double, Elements> sum(std::array<double, Elements> a,
                                           const std::array<double, Elements>& b) {
  for (std::size_t i = 0; i < Elements; ++i) a[i] += b[i];
  return a;
}

}  // namespace puck
