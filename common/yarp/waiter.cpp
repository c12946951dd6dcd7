#include "common/yarp/waiter.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include <sys/eventfd.h>
#include <unistd.h>

#include "common/yarp/yarp_error.h"

namespace puck {
namespace {

// Rounded up, to avoid repeated wake-ups just before the deadline.
int milliseconds_until(Deadline deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - SteadyClock::now());
  return static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 60'000));
}

}  // namespace

Waker::Waker() : calls_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (!calls_.is_open()) throw std::runtime_error(std::string("eventfd: ") + std::strerror(errno));
}

void Waker::wake() {
  const std::uint64_t one = 1;
  // Fails only after 2^64 - 2 calls without a wait, when the waiter is woken anyway.
  [[maybe_unused]] const ssize_t written = write(calls_.number(), &one, sizeof one);
}

void Waiter::wait(std::span<const pollfd> sockets, Deadline deadline) const {
  constexpr std::size_t kMostSockets = 7;
  std::array<pollfd, kMostSockets + 1> all{};
  const std::size_t count = std::min(sockets.size(), kMostSockets);
  std::copy_n(sockets.begin(), count, all.begin());
  all[count] = {waker_.calls_.number(), POLLIN, 0};
  poll(all.data(), count + 1, milliseconds_until(deadline));
  if (all[count].revents != 0) {
    std::uint64_t calls = 0;
    [[maybe_unused]] const ssize_t taken = read(waker_.calls_.number(), &calls, sizeof calls);
  }
}

bool Waiter::wait_for(int socket, short events, Deadline deadline) const {
  while (true) {
    if (is_stopped()) throw YarpError("stopped");
    // Checked before the socket, so that a socket that is always ready cannot extend the wait.
    if (SteadyClock::now() >= deadline) return false;
    pollfd ready{socket, events, 0};
    if (socket >= 0 && poll(&ready, 1, 0) > 0) return true;
    const std::array sockets{pollfd{socket, events, 0}};
    wait(sockets, deadline);
  }
}

}  // namespace puck
