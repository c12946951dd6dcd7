#pragma once

#include <cstddef>
#include <functional>

namespace puck {

/// Does `work` for each of 0 to count - 1, that many at a time, in threads of its own. When one
/// throws, no more are begun, and the exception is thrown on once those that run have ended.
void run_in_parallel(int threads, std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace puck
