#pragma once

#include <csignal>
#include <string>
#include <vector>

namespace puck {

/// A program started by a test; it is killed when the test ends without it.
class ChildProcess {
 public:
  /// Looks for the program in PATH when its name has no slash.
  explicit ChildProcess(const std::vector<std::string>& arguments);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  void send(int signal) { kill(pid_, signal); }
  /// Its exit code; -1: a signal ended it, or it could not be started.
  int wait();

 private:
  pid_t pid_ = -1;
};

}  // namespace puck
