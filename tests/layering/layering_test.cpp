#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/environment.h"

namespace puck {
namespace {

namespace fs = std::filesystem;

struct Include {
  fs::path file;
  int line = 0;
  std::string target;  // the text between the quotes or brackets
};

fs::path source_dir() { return source_folder(); }

std::vector<Include> includes_below(const fs::path& folder) {
  const std::regex include_line(R"(^\s*#\s*include\s*[<"]([^">]+)[">])");
  std::vector<Include> includes;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream file(entry.path());
    std::string text;
    for (int line = 1; std::getline(file, text); ++line) {
      std::smatch match;
      if (std::regex_search(text, match, include_line)) {
        includes.push_back({entry.path(), line, match[1]});
      }
    }
  }
  return includes;
}

std::vector<std::string> folders_below(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) names.push_back(entry.path().filename());
  }
  return names;
}

// The folder below `top` of a project include; empty for any other include.
std::string folder_of(const std::string& target, const std::string& top) {
  const fs::path path(target);
  auto part = path.begin();
  if (part == path.end() || *part != top) return {};
  return (++part)->string();
}

bool begins_with_any(const std::string& target, const std::vector<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const std::string& p) { return target.starts_with(p); });
}

// Allowed includes of each folder of common/ from the others.
const std::map<std::string, std::set<std::string>> kAllowed{
    {"events", {}},
    {"vision", {"events"}},
    {"baselines", {"events", "vision"}},
    {"table", {"events", "vision"}},
    {"posix", {}},
    {"motion", {}},
    {"calibration", {"events", "vision", "table", "motion"}},
    {"simulation", {"events", "vision", "table", "motion"}},
    {"evaluation", {"events", "vision", "table"}},
    {"plot", {}},
    {"runtime", {"events", "vision"}},
    {"io", {"events", "vision", "table", "motion"}},
    {"messaging", {"posix", "events", "vision", "table"}},
    {"recording", {"events", "io", "messaging"}},
    {"play", {"events", "vision", "table", "messaging"}},
    {"control", {"events", "vision", "table", "motion", "runtime", "messaging"}},
    {"yarp", {"posix", "control"}},
};

}  // namespace

TEST_CASE("every folder of common includes only the folders below it") {
  const fs::path common = source_dir() / "common";
  for (const std::string& folder : folders_below(common)) {
    CAPTURE(folder);
    REQUIRE(kAllowed.contains(folder));
    for (const Include& include : includes_below(common / folder)) {
      const std::string other = folder_of(include.target, "common");
      const bool allowed = other.empty() || other == folder || kAllowed.at(folder).contains(other);
      CHECK_MESSAGE(allowed, include.file.string(), ":", include.line, " includes ",
                    include.target);
      CHECK_MESSAGE(!include.target.starts_with("services/"), include.file.string());
      CHECK_MESSAGE(!include.target.starts_with("tools/"), include.file.string());
    }
  }
}

TEST_CASE("the core knows no LCM, OpenCV, thread, wall clock, file or log") {
  const std::vector<std::string> forbidden{
      "lcm/",   "puck/",   "opencv2/", "Eigen/",  "spdlog/",     "toml",
      "thread", "mutex",   "atomic",   "future",  "chrono",      "condition_variable",
      "ctime",  "fstream", "iostream", "cstdio",  "filesystem",  "unistd.h",
      "sys/",   "pthread", "time.h",   "stdio.h", "shared_mutex"};
  for (const std::string folder : {"events", "vision", "baselines", "table"}) {
    for (const Include& include : includes_below(source_dir() / "common" / folder)) {
      CHECK_MESSAGE(!begins_with_any(include.target, forbidden), include.file.string(), ":",
                    include.line, " includes ", include.target);
    }
  }
}

TEST_CASE("only messaging includes LCM's headers") {
  for (const std::string top : {"common", "services", "tools"}) {
    for (const Include& include : includes_below(source_dir() / top)) {
      if (include.file.string().find("/common/messaging/") != std::string::npos) continue;
      CHECK_MESSAGE(!include.target.starts_with("lcm/"), include.file.string(), ":", include.line);
    }
  }
}

TEST_CASE("services and tools never include one another, except their common part") {
  for (const std::string top : {"services", "tools"}) {
    for (const std::string& folder : folders_below(source_dir() / top)) {
      for (const Include& include : includes_below(source_dir() / top / folder)) {
        const std::string service = folder_of(include.target, "services");
        const std::string tool = folder_of(include.target, "tools");
        const bool own = (top == "services" ? service : tool) == folder;
        const bool shared = (top == "services" && service == "launch") ||
                            (top == "tools" && tool == "command_line");
        const bool allowed = (service.empty() && tool.empty()) || own || shared;
        CHECK_MESSAGE(allowed, include.file.string(), ":", include.line, " includes ",
                      include.target);
      }
    }
  }
}

TEST_CASE("the reader of include lines finds includes") {
  const auto includes = includes_below(source_dir() / "common" / "vision");
  CHECK(includes.size() > 40);
  CHECK(folder_of("common/vision/region.h", "common") == "vision");
  CHECK(folder_of("vector", "common").empty());
}

}  // namespace puck
