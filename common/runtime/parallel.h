#pragma once

#include <cstddef>
#include <functional>

namespace puck {

/// Calls `work` for 0 to count - 1, on up to `threads` new threads. When a call throws, no further
/// call is started, and the exception is rethrown once the running calls have ended.
void run_in_parallel(int threads, std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace puck
