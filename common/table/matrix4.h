#pragma once

#include <array>
#include <cstddef>

namespace puck {

/// Two by two, row by row.
using Matrix2 = std::array<double, 4>;
/// Four by four, row by row.
using Matrix4 = std::array<double, 16>;

constexpr Matrix4 diagonal(double a, double b, double c, double d) {
  return {a, 0, 0, 0, 0, b, 0, 0, 0, 0, c, 0, 0, 0, 0, d};
}

constexpr Matrix4 product(const Matrix4& a, const Matrix4& b) {
  Matrix4 result{};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      for (std::size_t k = 0; k < 4; ++k) {
        result[4 * row + column] += a[4 * row + k] * b[4 * k + column];
      }
    }
  }
  return result;
}

constexpr Matrix4 transposed(const Matrix4& a) {
  Matrix4 result{};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column)
      result[4 * column + row] = a[4 * row + column];
  }
  return result;
}

/// The covariance `p` carried through the linear map `f`: f p fᵀ.
constexpr Matrix4 carried(const Matrix4& f, const Matrix4& p) {
  return product(product(f, p), transposed(f));
}

constexpr Matrix4 sum(const Matrix4& a, const Matrix4& b) {
  Matrix4 result = a;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += b[i];
  return result;
}

/// The mean of a matrix and its transpose: takes rounding out of a covariance.
constexpr Matrix4 symmetric_part(const Matrix4& a) {
  Matrix4 result = sum(a, transposed(a));
  for (double& element : result) element /= 2;
  return result;
}

}  // namespace puck
