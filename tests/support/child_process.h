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
  std::filesystem::path folder;  ///< Working directory; empty: the test's own.
  std::filesystem::path input;   ///< File on stdin; empty: none.
  std::filesystem::path output;  ///< File for stdout; empty: the test's stdout.
  std::filesystem::path errors;  ///< File for stderr; likewise.
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
  /// Does nothing if it has ended already.
  void send(int signal);
  /// Sends to it and all its children, as Ctrl-C in a terminal does.
  void send_to_group(int signal);
  /// Whether any process of its group still exists after its own end.
  bool group_is_left() const;

  /// Its exit code; -1: a signal ended it, or it could not be started.
  int wait();
  /// The same; nothing if it still runs after `timeout`.
  std::optional<int> wait_for(std::chrono::milliseconds timeout);

 private:
  std::optional<int> reap(int options);

  pid_t pid_ = -1;
  std::optional<int> exit_code_;
};

/// The result of a finished program.
struct Finished {
  int exit_code = -1;  ///< -1: ended by a signal, or killed at its time limit.
  std::string output;  ///< Its stdout.
  std::string errors;  ///< Its stderr.
};

/// Runs a program to its end, and kills it after `time`. Of the options only folder and input are
/// used.
Finished run_program(const std::vector<std::string>& arguments, const ChildOptions& options = {},
                     std::chrono::seconds time = std::chrono::seconds(60));

}  // namespace puck
