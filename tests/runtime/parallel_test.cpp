#include "common/runtime/parallel.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("every item is done once, with any number of threads") {
  for (const int threads : {1, 2, 7}) {
    std::vector<std::atomic<int>> done(100);
    run_in_parallel(threads, done.size(), [&](std::size_t i) { ++done[i]; });
    for (const auto& count : done) CHECK(count == 1);
  }
}

TEST_CASE("an exception is passed on and no further item is begun") {
  int begun = 0;
  CHECK_THROWS_AS(run_in_parallel(1, 100,
                                  [&](std::size_t) {
                                    if (++begun == 3) throw std::runtime_error("failed");
                                  }),
                  std::runtime_error);
  CHECK(begun == 3);
}

}  // namespace puck
