#include "tools/compare/program.h"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace puck {
namespace {

constexpr std::size_t kToldBytes = 600;

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

}  // namespace

ProgramEnd run_program_to_end(const std::vector<std::string>& command,
                              const std::filesystem::path& output,
                              const std::filesystem::path& errors) {
  std::vector<char*> arguments;
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);

  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
  constexpr mode_t kReadableByAll = 0644;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), kWrite, kReadableByAll);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), kWrite, kReadableByAll);
  pid_t child = 0;
  const int failure =
      posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return {};

  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  ProgramEnd end;
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  end.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  return end;
}

double run_or_throw(const std::vector<std::string>& command, const std::filesystem::path& folder) {
  const ProgramEnd end = run_program_to_end(command, folder / "output.txt", folder / "errors.txt");
  if (end.exit_code == 0) return end.cpu_s;
  std::string message;
  for (const std::string& word : command) message += (message.empty() ? "" : " ") + word;
  message += "\nended with exit code " + std::to_string(end.exit_code) + " and printed:\n";
  const std::string said = read_whole_file(folder / "errors.txt");
  throw std::runtime_error(message +
                           said.substr(said.size() > kToldBytes ? said.size() - kToldBytes : 0));
}

std::string read_whole_file(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace puck
