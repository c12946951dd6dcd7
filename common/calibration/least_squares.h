#pragma once

#include <functional>

#include <Eigen/Core>

namespace puck {

/// Fills the residuals that belong to the parameters; their number never changes.
using ResidualFunction =
    std::function<void(const Eigen::VectorXd& parameters, Eigen::VectorXd& residuals)>;

/// Where the sum of the squared residuals is smallest, sought from `start` on by Levenberg and
/// Marquardt's method (MINPACK's, as it is in Eigen), with derivatives by differences. There must be
/// as many residuals as parameters or more.
Eigen::VectorXd least_squares(const Eigen::VectorXd& start, Eigen::Index residual_count,
                              const ResidualFunction& residuals);

}  // namespace puck
