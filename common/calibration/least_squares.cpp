#include "common/calibration/least_squares.h"

#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

namespace puck {
namespace {

// The interface that Eigen's solver requires, names included.
struct Residuals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  int inputs() const { return static_cast<int>(parameter_count); }
  int values() const { return static_cast<int>(residual_count); }
  int operator()(const Eigen::VectorXd& parameters, Eigen::VectorXd& residuals) const {
    function(parameters, residuals);
    return 0;
  }

  Eigen::Index parameter_count;
  Eigen::Index residual_count;
  const ResidualFunction& function;
};

}  // namespace

Eigen::VectorXd least_squares(const Eigen::VectorXd& start, Eigen::Index residual_count,
                              const ResidualFunction& residuals) {
  Eigen::NumericalDiff<Residuals, Eigen::Central> function(
      Residuals{start.size(), residual_count, residuals});
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Residuals, Eigen::Central>> solver(function);
  Eigen::VectorXd parameters = start;
  solver.minimize(parameters);
  return parameters;
}

}  // namespace puck
