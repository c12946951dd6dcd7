#include "common/runtime/parallel.h"

#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace puck {

void run_in_parallel(int threads, std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::exception_ptr> failures(count);
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < threads; ++i) {
      workers.emplace_back([&] {
        for (std::size_t n = next++; n < count; n = next++) {
          try {
            work(n);
          } catch (...) {
            failures[n] = std::current_exception();
            next = count;
          }
        }
      });
    }
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace puck
