#pragma once

#include <cstdlib>
#include <exception>
#include <functional>
#include <string>
#include <thread>

#include <doctest/doctest.h>
#include <sched.h>

namespace puck {

/// Runs `work` on a thread with an own network, which has an active loopback only, and waits for
/// it. False, with a message, where this user may not make one.
inline bool in_network_of_its_own(const std::function<void()>& work) {
  bool permitted = false;
  std::exception_ptr failure;
  std::thread([&] {
    permitted = unshare(CLONE_NEWNET) == 0 && std::system("ip link set lo up") == 0;
    if (!permitted) return;
    try {
      work();
    } catch (...) {  // thrown by REQUIRE
      failure = std::current_exception();
    }
  }).join();
  if (failure) std::rethrow_exception(failure);
  if (!permitted) MESSAGE("skipped: network namespaces need more rights than this user has");
  return permitted;
}

/// Runs ip(8) with `arguments` in this thread's network.
inline bool ip(const std::string& arguments) {
  return std::system(("ip " + arguments).c_str()) == 0;
}

}  // namespace puck
