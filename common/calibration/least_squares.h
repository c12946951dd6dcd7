#pragma once

#include <functional>

#include <Eigen/Core>

namespace puck {

/// Computes the residuals for the parameters; their number is constant.
using ResidualFunction =
    std::function<void(const Eigen::VectorXd& parameters, Eigen::VectorXd& residuals)>;

/// Minimises the sum of the squared residuals from `start` by Levenberg and Marquardt's method
/// (MINPACK's, as in Eigen), with numerical derivatives. There must be at least as many residuals
/// as parameters.
Eigen::VectorXd least_squares(const Eigen::VectorXd& start, Eigen::Index residual_count,
                              const ResidualFunction& residuals);

}  // namespace puck
