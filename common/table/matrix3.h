#pragma once

#include <array>

#include "common/table/square_matrix.h"

namespace puck {

/// 3 × 3, row-major.
using Matrix3 = SquareMatrix<3>;
using Column3 = std::array<double, 3>;

constexpr Column3 product(const Matrix3& a, const Column3& v) {
  return {a[0] * v[0] + a[1] * v[1] + a[2] * v[2], a[3] * v[0] + a[4] * v[1] + a[5] * v[2],
          a[6] * v[0] + a[7] * v[1] + a[8] * v[2]};
}

constexpr Matrix3 scaled(Matrix3 a, double factor) {
  for (double& element : a) element *= factor;
  return a;
}

constexpr double determinant(const Matrix3& a) {
  return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) +
         a[2] * (a[3] * a[7] - a[4] * a[6]);
}

/// The determinant must not be 0.
constexpr Matrix3 inverse(const Matrix3& a) {
  return scaled({a[4] * a[8] - a[5] * a[7], a[2] * a[7] - a[1] * a[8], a[1] * a[5] - a[2] * a[4],
                 a[5] * a[6] - a[3] * a[8], a[0] * a[8] - a[2] * a[6], a[2] * a[3] - a[0] * a[5],
                 a[3] * a[7] - a[4] * a[6], a[1] * a[6] - a[0] * a[7], a[0] * a[4] - a[1] * a[3]},
                1 / determinant(a));
}

}  // namespace puck
