#pragma once

#include <string>
#include <vector>

#include <sys/types.h>
#include <termios.h>

namespace puck {

/// A program in a terminal of its own, of 80 x 24 characters; killed when the test ends without it.
/// One thread.
class TerminalProcess {
 public:
  /// `type`: the terminal's, as in TERM. Throws std::runtime_error without a terminal.
  explicit TerminalProcess(const std::vector<std::string>& arguments, const char* type = "xterm");
  ~TerminalProcess();
  TerminalProcess(const TerminalProcess&) = delete;
  TerminalProcess& operator=(const TerminalProcess&) = delete;

  /// Reads the output until this appears, and forgets it; false if the program ends before, or
  /// writes nothing for 20 s.
  bool reads(const std::string& text);
  void type(const std::string& keys);
  void resize(unsigned short columns, unsigned short rows);
  /// As the program has set the terminal.
  termios settings() const;
  void send(int signal);
  /// The exit code; -1: ended by a signal.
  int wait();

 private:
  int terminal_ = -1;
  pid_t pid_ = -1;
  std::string output_;
};

}  // namespace puck
