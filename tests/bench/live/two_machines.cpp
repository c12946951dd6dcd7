#include "tests/bench/live/two_machines.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

namespace puck {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw NoNetwork("part network not measured: " + what + "; it takes root and iproute2");
}

void enter_new_network() {
  if (unshare(CLONE_NEWNET) != 0) fail(std::strerror(errno));
}

void ip(const std::string& arguments) {
  if (std::system(("ip " + arguments).c_str()) != 0) fail("ip " + arguments);
}

void plug_in(const std::string& address) {
  ip("link set lo up");
  ip("addr add " + address + "/24 dev cable");
  ip("link set cable up");
  ip("route add 224.0.0.0/4 dev cable");
}

}  // namespace

TwoMachines::Network::~Network() {
  if (descriptor_ >= 0) close(descriptor_);
}

void TwoMachines::Network::open_own() {
  descriptor_ = open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail(std::strerror(errno));
}

void TwoMachines::Network::enter() const {
  if (setns(descriptor_, CLONE_NEWNET) != 0) fail(std::strerror(errno));
}

std::string TwoMachines::Network::path() const {
  return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(descriptor_);
}

TwoMachines::TwoMachines() {
  home_.open_own();
  try {
    enter_new_network();
    second_.open_own();
    enter_new_network();
    first_.open_own();
    ip("link add cable type veth peer name cable netns " + second_.path());
    plug_in("10.9.8.1");
    on_second([] { plug_in("10.9.8.2"); });
  } catch (...) {
    home_.enter();
    throw;
  }
}

// Entering the first network again cannot fail.
TwoMachines::~TwoMachines() { home_.enter(); }

void TwoMachines::on_second(const std::function<void()>& work) const {
  second_.enter();
  try {
    work();
  } catch (...) {
    first_.enter();
    throw;
  }
  first_.enter();
}

}  // namespace puck
