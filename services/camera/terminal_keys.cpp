#include "services/camera/terminal_keys.h"

#include <array>
#include <string_view>
#include <utility>

#include <unistd.h>

namespace puck {
namespace {

using Kind = ReplayRequest::Kind;

constexpr std::int64_t kSmallJumpUs = 1'000'000;
constexpr std::int64_t kLargeJumpUs = 10'000'000;
constexpr char kEscape = '\x1b';

std::optional<ReplayRequest> request_of_key(char key) {
  switch (key) {
    case ' ':
      return ReplayRequest{.kind = Kind::kPauseOrResume};
    case '.':
      return ReplayRequest{.kind = Kind::kStep};
    case '+':
    case '=':  // The same key on many keyboards, without shift.
      return ReplayRequest{.kind = Kind::kFaster, .speed = 2};
    case '-':
      return ReplayRequest{.kind = Kind::kFaster, .speed = 0.5};
    default:
      return std::nullopt;
  }
}

std::optional<ReplayRequest> request_of_arrow(char letter) {
  switch (letter) {
    case 'A':
      return ReplayRequest{.kind = Kind::kSeekBy, .us = kLargeJumpUs};
    case 'B':
      return ReplayRequest{.kind = Kind::kSeekBy, .us = -kLargeJumpUs};
    case 'C':
      return ReplayRequest{.kind = Kind::kSeekBy, .us = kSmallJumpUs};
    case 'D':
      return ReplayRequest{.kind = Kind::kSeekBy, .us = -kSmallJumpUs};
    default:
      return std::nullopt;
  }
}

}  // namespace

TerminalKeys::TerminalKeys() {
  is_on_ = isatty(STDIN_FILENO) == 1 && tcgetattr(STDIN_FILENO, &before_) == 0 &&
           is_in_foreground() && take_over();
}

// A process in the background would be stopped if it changed the terminal; the shell has restored
// it.
TerminalKeys::~TerminalKeys() {
  if (is_on_ && is_in_foreground()) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

// Signal keys stay: Ctrl-C ends the service, Ctrl-Z stops it.
bool TerminalKeys::take_over() {
  termios single_keys = before_;
  single_keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  single_keys.c_cc[VMIN] = 0;
  single_keys.c_cc[VTIME] = 0;
  return tcsetattr(STDIN_FILENO, TCSANOW, &single_keys) == 0;
}

bool TerminalKeys::is_in_foreground() const { return tcgetpgrp(STDIN_FILENO) == getpgrp(); }

std::optional<ReplayRequest> TerminalKeys::read() {
  if (!is_on_ || !is_in_foreground()) return std::nullopt;
  if (typed_.size() < 2 && !read_typed()) return std::nullopt;
  return next_request();
}

// Returns false if nothing was typed before either.
bool TerminalKeys::read_typed() {
  termios now{};
  // After Ctrl-Z and fg, the shell's own settings are in force.
  if (tcgetattr(STDIN_FILENO, &now) == 0 && (now.c_lflag & ICANON) != 0 && !take_over())
    return false;
  std::array<char, 64> keys{};
  const ssize_t count = ::read(STDIN_FILENO, keys.data(), keys.size());
  if (count > 0) typed_.append(keys.data(), static_cast<std::size_t>(count));
  return !typed_.empty();
}

std::optional<ReplayRequest> TerminalKeys::next_request() {
  while (!typed_.empty()) {
    if (typed_.front() == kEscape) {
      // An arrow is Escape, [ or O, and a letter.
      const std::string_view sequence = typed_;
      const bool may_be_arrow = sequence.size() < 2 || sequence[1] == '[' || sequence[1] == 'O';
      if (may_be_arrow && sequence.size() < 3) return std::nullopt;
      const auto request = may_be_arrow ? request_of_arrow(sequence[2]) : std::nullopt;
      typed_.erase(0, may_be_arrow ? 3 : 1);
      if (request) return request;
      continue;
    }
    const char key = typed_.front();
    typed_.erase(0, 1);
    if (key == '?' || key == 'h') was_help_asked_ = true;
    if (const auto request = request_of_key(key)) return request;
  }
  return std::nullopt;
}

bool TerminalKeys::was_help_asked() { return std::exchange(was_help_asked_, false); }

}  // namespace puck
