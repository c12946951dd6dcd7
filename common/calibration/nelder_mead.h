#pragma once

#include <functional>
#include <span>
#include <vector>

namespace puck {

/// Minimises a function without derivatives, by Nelder and Mead's method (OpenCV's), from `start`
/// and a simplex with edges of `step`.
std::vector<double> nelder_mead(std::span<const double> start, double step,
                                const std::function<double(std::span<const double>)>& function);

}  // namespace puck
