#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace puck {

struct ChildOptions {
  std::filesystem::path folder;  ///< To start in; empty: the test's own.
  std::filesystem::path input;   ///< What it reads from stdin; empty: nothing.
  std::filesystem::path output;  ///< Where stdout goes; empty: where the test's does.
  std::filesystem::path errors;  ///< Where stderr goes; the same.
};

/// A program started by a test, in a process group of its own; the whole group is killed when the
/// test ends without it. One thread.
class ChildProcess {
 public:
  /// Looks for the program in PATH when its name has no slash.
  explicit ChildProcess(const std::vector<std::string>& arguments,
                        const ChildOptions& options = {});
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }
  bool is_running();
  /// Nothing when it has ended already.
  void send(int signal);
  /// To it and to all that it started, as Ctrl-C in a terminal does.
  void send_to_group(int signal);
  /// Whether anything that it started is still there, once it has ended itself.
  bool group_is_left() const;

  /// Its exit code; -1: a signal ended it, or it could not be started.
  int wait();
  /// The same; nothing when it still runs after `timeout`.
  std::optional<int> wait_for(std::chrono::milliseconds timeout);

 private:
  std::optional<int> reap(int options);

  pid_t pid_ = -1;
  std::optional<int> exit_code_;
};

/// How a program ended that ran to its end.
struct Finished {
  int exit_code = -1;  ///< -1: a signal ended it, or it was killed after its time.
  std::string output;  ///< Its stdout.
  std::string errors;  ///< Its stderr.
};

/// Runs a program to its end, and kills it when that takes longer than `time`. Of the options only
/// folder and input count.
Finished run_program(const std::vector<std::string>& arguments, const ChildOptions& options = {},
                     std::chrono::seconds time = std::chrono::seconds(60));

}  // namespace puck
