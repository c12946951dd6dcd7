#pragma once

#include <cstdint>

namespace puck::test {

/// How often the calling thread has asked `new` for memory since its start.
std::int64_t own_allocations();

}  // namespace puck::test
