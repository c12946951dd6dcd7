#include "tools/info/plots.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/io/temporary_path.h"
#include "tools/info/report.h"

namespace puck {
namespace {

// Waits for its end; what it prints goes to stderr. Returns its exit code, −1 if it did not run.
int run_python(std::string script, std::string json, std::string folder) {
  std::string python = "python3";
  const std::array<char*, 5> arguments{python.data(), script.data(), json.data(), folder.data(),
                                       nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, python.c_str(), nullptr, nullptr, arguments.data(), environ) != 0) {
    return -1;
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

}  // namespace

void draw_survey(const Survey& survey, const std::filesystem::path& folder) {
  if (survey.counters.events == 0) throw std::runtime_error("--plots: there are no events to draw");
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(folder.string() +
                             ": the folder cannot be created: " + error.message());
  }
  const TemporaryPath json("puck-info-");
  std::ofstream(json.path(), std::ios::binary) << survey_json(survey, true);
  const auto script =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "charts" / "info.py";
  if (run_python(script.string(), json.path().string(), folder.string()) != 0) {
    throw std::runtime_error(folder.string() + ": no charts; they need " + script.string() +
                             " and matplotlib (apt-get install python3-matplotlib)");
  }
}

}  // namespace puck
