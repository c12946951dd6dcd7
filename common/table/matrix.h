#pragma once

#include <Eigen/Core>

namespace puck {

using Matrix2 = Eigen::Matrix2d;
using Matrix3 = Eigen::Matrix3d;
using Matrix4 = Eigen::Matrix4d;
using Column3 = Eigen::Vector3d;

inline Matrix4 diagonal(double a, double b, double c, double d) {
  return Eigen::Vector4d(a, b, c, d).asDiagonal();
}

/// The covariance `p` propagated through the linear map `f`: f p fᵀ.
inline Matrix4 carried(const Matrix4& f, const Matrix4& p) { return f * p * f.transpose(); }

/// The mean of a matrix and its transpose: removes rounding errors from a covariance.
inline Matrix4 symmetric_part(const Matrix4& a) { return (a + a.transpose()) / 2; }

}  // namespace puck
