#pragma once

#include <cstdint>
#include <random>

namespace puck {

/// Random, never 0: identifies a run on the wire.
inline std::int64_t random_session() {
  // Below 2^53, so that tools with numbers in doubles keep it exact.
  std::random_device random;
  std::uniform_int_distribution<std::int64_t> ids(1, (std::int64_t{1} << 53) - 1);
  return ids(random);
}

}  // namespace puck
