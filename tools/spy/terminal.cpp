#include "tools/spy/terminal.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

#define NCURSES_NOMACROS  // Its macros clear and move would replace our names.
#include <ncurses.h>
#include <unistd.h>

namespace puck {
namespace {

constexpr short kWarningColour = 1;
constexpr short kAlarmColour = 2;
constexpr int kEscape = 27;
constexpr int kEscapeDelay_ms = 25;  // Separates a single escape from a key's sequence.

attr_t attributes_of(const ScreenLine& line) {
  attr_t attributes = line.selected ? A_REVERSE : A_NORMAL;
  switch (line.style) {
    case LineStyle::kPlain:
      break;
    case LineStyle::kTitle:
      attributes |= A_BOLD;
      break;
    case LineStyle::kHead:
      attributes |= A_UNDERLINE;
      break;
    case LineStyle::kWarning:
      attributes |= has_colors() ? static_cast<attr_t>(COLOR_PAIR(kWarningColour)) : A_BOLD;
      break;
    case LineStyle::kAlarm:
      attributes |= A_BOLD | (has_colors() ? static_cast<attr_t>(COLOR_PAIR(kAlarmColour)) : 0);
      break;
    case LineStyle::kFaint:
      attributes |= A_DIM;
      break;
  }
  return attributes;
}

std::optional<SpyKey> key_of(int code) {
  switch (code) {
    case KEY_UP:
    case 'k':
      return SpyKey::kUp;
    case KEY_DOWN:
    case 'j':
      return SpyKey::kDown;
    case KEY_PPAGE:
      return SpyKey::kPageUp;
    case KEY_NPAGE:
      return SpyKey::kPageDown;
    case KEY_HOME:
    case 'g':
      return SpyKey::kFirst;
    case KEY_END:
    case 'G':
      return SpyKey::kLast;
    case KEY_ENTER:
    case '\n':
    case '\r':
      return SpyKey::kShow;
    case kEscape:
    case KEY_LEFT:
    case KEY_BACKSPACE:
    case 127:
      return SpyKey::kBack;
    case 's':
      return SpyKey::kSort;
    case 'r':
      return SpyKey::kReverse;
    case 'p':
    case ' ':
      return SpyKey::kPause;
    case 'o':
      return SpyKey::kOthers;
    case 'h':
    case '?':
      return SpyKey::kHelp;
    case 'q':
      return SpyKey::kQuit;
    default:
      return std::nullopt;
  }
}

}  // namespace

Terminal::Terminal() {
  if (isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0) {
    throw std::runtime_error("the live view needs a terminal; without one use --once");
  }
  // Unlike newterm(), initscr() ends the program on failure.
  if (newterm(nullptr, stdout, stdin) == nullptr) {
    const char* const type = std::getenv("TERM");
    throw std::runtime_error("the terminal's type is not known: TERM=" +
                             std::string(type == nullptr ? "" : type) + "; try TERM=xterm");
  }
  cbreak();
  noecho();
  curs_set(0);
  keypad(stdscr, true);
  nodelay(stdscr, true);
  set_escdelay(kEscapeDelay_ms);
  if (has_colors()) {
    start_color();
    use_default_colors();
    init_pair(kWarningColour, COLOR_YELLOW, -1);
    init_pair(kAlarmColour, COLOR_RED, -1);
  }
}

Terminal::~Terminal() { endwin(); }

ScreenSize Terminal::size() const { return {getmaxx(stdscr), getmaxy(stdscr)}; }

void Terminal::show(const Screen& screen) {
  erase();
  int row = 0;
  for (const ScreenLine& line : screen) {
    attrset(static_cast<int>(attributes_of(line)));
    mvaddstr(row++, 0, line.text.c_str());
  }
  refresh();
}

std::optional<SpyKey> Terminal::read_key() {
  for (int code = getch(); code != ERR; code = getch()) {
    if (code == KEY_RESIZE) resized_ = true;
    if (const auto key = key_of(code)) return key;
  }
  return std::nullopt;
}

bool Terminal::was_resized() {
  const bool resized = resized_;
  resized_ = false;
  return resized;
}

}  // namespace puck
