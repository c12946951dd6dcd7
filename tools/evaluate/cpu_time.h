#pragma once

#include <cstdint>
#include <ctime>

namespace puck {

/// Sums the CPU time of calls over all threads of this process: a tracker's cost without reading
/// the events. One thread.
class CpuTime {
 public:
  template <typename Call>
  decltype(auto) of(const Call& call) {
    const Stop stop{*this, now_ns()};
    return call();
  }

  double total_us() const { return static_cast<double>(total_ns_) * 1e-3; }

 private:
  struct Stop {
    ~Stop() { time.total_ns_ += now_ns() - begin_ns; }
    CpuTime& time;
    std::int64_t begin_ns;
  };

  static std::int64_t now_ns() {
    std::timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  }

  std::int64_t total_ns_ = 0;
};

}  // namespace puck
