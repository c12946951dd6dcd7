#include "common/calibration/nelder_mead.h"

#include <cstddef>

#include <opencv2/core.hpp>
#include <opencv2/core/optim.hpp>

namespace puck {
namespace {

// The interface that OpenCV's solver requires, names included.
class Function final : public cv::MinProblemSolver::Function {
 public:
  Function(std::size_t size, const std::function<double(std::span<const double>)>& function)
      : size_(size), function_(function) {}

  int getDims() const override { return static_cast<int>(size_); }
  double calc(const double* x) const override { return function_({x, size_}); }

 private:
  std::size_t size_;
  const std::function<double(std::span<const double>)>& function_;
};

}  // namespace

std::vector<double> nelder_mead(std::span<const double> start, double step,
                                const std::function<double(std::span<const double>)>& function) {
  constexpr int kMostSteps = 1'000;
  constexpr double kPrecision = 1e-7;
  // A simplex may collapse before it is at the minimum: a second one begins where the first ends.
  constexpr int kRuns = 2;
  const int size = static_cast<int>(start.size());
  cv::Mat x(1, size, CV_64F);
  for (int i = 0; i < size; ++i) x.at<double>(i) = start[static_cast<std::size_t>(i)];
  const auto solver = cv::DownhillSolver::create(
      cv::makePtr<Function>(start.size(), function), cv::Mat(1, size, CV_64F, cv::Scalar(step)),
      {cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, kMostSteps, kPrecision});
  for (int run = 0; run < kRuns; ++run) solver->minimize(x);
  return {x.begin<double>(), x.end<double>()};
}

}  // namespace puck
