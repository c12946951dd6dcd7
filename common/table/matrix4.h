#pragma once

#include "common/table/square_matrix.h"

namespace puck {

/// 2 × 2, row-major.
using Matrix2 = std::array<double, 4>;
/// 4 × 4, row-major.
using Matrix4 = SquareMatrix<4>;

constexpr Matrix4 diagonal(double a, double b, double c, double d) {
  return {a, 0, 0, 0, 0, b, 0, 0, 0, 0, c, 0, 0, 0, 0, d};
}

/// The covariance `p` propagated through the linear map `f`: f p fᵀ.
constexpr Matrix4 carried(const Matrix4& f, const Matrix4& p) {
  return product(product(f, p), transposed(f));
}

/// The mean of a matrix and its transpose: removes rounding errors from a covariance.
constexpr Matrix4 symmetric_part(const Matrix4& a) {
  Matrix4 result = sum(a, transposed(a));
  for (double& element : result) element /= 2;
  return result;
}

}  // namespace puck
