#include "tests/support/terminal_process.h"

#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace puck {

TerminalProcess::TerminalProcess(const std::vector<std::string>& arguments, const char* type) {
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) {
    pointers.push_back(const_cast<char*>(argument.c_str()));
  }
  pointers.push_back(nullptr);
  winsize size{.ws_row = 24, .ws_col = 80, .ws_xpixel = 0, .ws_ypixel = 0};
  pid_ = forkpty(&terminal_, nullptr, nullptr, &size);
  if (pid_ < 0) throw std::runtime_error("no terminal");
  if (pid_ > 0) return;
  setenv("TERM", type, 1);
  execv(pointers[0], pointers.data());
  _exit(127);
}

TerminalProcess::~TerminalProcess() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  close(terminal_);
}

bool TerminalProcess::reads(const std::string& text) {
  constexpr int kLongestSilenceMs = 20'000;
  std::string part(4096, 0);
  while (output_.find(text) == std::string::npos) {
    pollfd waiting{terminal_, POLLIN, 0};
    if (poll(&waiting, 1, kLongestSilenceMs) == 0) return false;
    ssize_t count = read(terminal_, part.data(), part.size());
    // Its last output may arrive after the kernel reports its end.
    if (count <= 0) count = read(terminal_, part.data(), part.size());
    if (count <= 0) return false;
    output_.append(part, 0, static_cast<std::size_t>(count));
  }
  output_.erase(0, output_.find(text) + text.size());
  return true;
}

void TerminalProcess::type(const std::string& keys) {
  if (write(terminal_, keys.data(), keys.size()) != static_cast<ssize_t>(keys.size())) {
    throw std::runtime_error("the terminal takes no keys");
  }
}

void TerminalProcess::resize(unsigned short columns, unsigned short rows) {
  const winsize size{.ws_row = rows, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
  if (ioctl(terminal_, TIOCSWINSZ, &size) != 0) throw std::runtime_error("no other size");
}

termios TerminalProcess::settings() const {
  termios settings{};
  if (tcgetattr(terminal_, &settings) != 0) throw std::runtime_error("no settings");
  return settings;
}

void TerminalProcess::send(int signal) { kill(pid_, signal); }

int TerminalProcess::wait() {
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace puck
