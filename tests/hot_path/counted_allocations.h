#pragma once

#include <cstdint>

namespace puck::test {

/// Calls of `new` by the calling thread since its start.
std::int64_t own_allocations();

}  // namespace puck::test
