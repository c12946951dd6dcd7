#include "tools/charts/draw_charts.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include <sys/wait.h>

namespace puck {
namespace {

// The shell's exit codes for a program that cannot be started.
constexpr int kNotExecutable = 126;
constexpr int kNotFound = 127;

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char letter : word) text += letter == '\'' ? "'\\''" : std::string(1, letter);
  return text + "'";
}

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

void draw_charts(const std::string& script, const std::vector<std::string>& arguments) {
  const std::string path =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "charts" / (script + ".py");
  std::string command = quoted(path);
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error(path + ": no process can be started");
  std::string told;
  std::array<char, 512> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) told += part.data();
  const int status = pclose(pipe);
  if (status == 0) return;
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (exit_code == kNotFound || exit_code == kNotExecutable) {
    throw std::runtime_error(path +
                             ": cannot be started; charts need this file and Python with "
                             "matplotlib: apt-get install python3-matplotlib");
  }
  throw std::runtime_error(told.empty() ? path + " failed" : last_line(told));
}

}  // namespace puck
