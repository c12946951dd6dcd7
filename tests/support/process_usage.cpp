#include "tests/support/process_usage.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include <unistd.h>

namespace puck {
namespace {

double cpu_seconds(const std::filesystem::path& process) {
  std::ifstream file(process / "stat");
  std::string text;
  std::getline(file, text);
  // The second field, the name in brackets, may contain spaces; user and system time, in ticks, are
  // the 14th and the 15th.
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string skipped;
  for (int i = 3; i < 14; ++i) fields >> skipped;
  double user_ticks = 0;
  double system_ticks = 0;
  fields >> user_ticks >> system_ticks;
  if (!fields) throw std::runtime_error(process.string() + "/stat cannot be read");
  return (user_ticks + system_ticks) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

std::int64_t voluntary_switches(const std::filesystem::path& thread) {
  std::ifstream file(thread / "status");
  for (std::string key; file >> key;) {
    std::int64_t count = 0;
    if (key == "voluntary_ctxt_switches:" && file >> count) return count;
    std::string rest;
    std::getline(file, rest);
  }
  return 0;  // It has just ended.
}

}  // namespace

double resident_mb(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/statm");
  double pages = 0;
  double resident_pages = 0;
  file >> pages >> resident_pages;
  if (!file) throw std::runtime_error("/proc/" + std::to_string(pid) + "/statm cannot be read");
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

ProcessUsage usage_of(pid_t pid) {
  const std::filesystem::path process = std::filesystem::path("/proc") / std::to_string(pid);
  ProcessUsage usage{.cpu_s = cpu_seconds(process)};
  for (const auto& thread : std::filesystem::directory_iterator(process / "task")) {
    usage.wake_ups += voluntary_switches(thread.path());
  }
  return usage;
}

}  // namespace puck
