#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace puck {

/// The smallest of the sorted values that is at least as large as `fraction` of them. `sorted` must
/// not be empty; `fraction` from 0 to 1.
template <typename T>
T quantile(const std::vector<T>& sorted, double fraction) {
  const auto rank =
      static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace puck
