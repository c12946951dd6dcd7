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

// The part of common/ that a path below it lies in: a folder, or a room of vision.
std::string part_of(const fs::path& path) {
  const std::string folder = path.begin()->string();
  const std::string room = path.parent_path().string();
  return folder == "vision" ? room : folder;
}

using Parts = std::set<std::string>;

// Allowed includes of each part of common/ from the others. "vision" includes its rooms.
const std::map<std::string, Parts> kAllowed{
    {"events", {}},
    {"vision/geometry", {"events"}},
    {"vision/surface", {"events", "vision/geometry"}},
    {"vision/correlation", {"events", "vision/geometry"}},
    {"vision/contour", {"events", "vision/geometry"}},
    {"vision/scene", {"events", "vision/geometry"}},
    {"vision/interfaces", {"events", "vision/geometry", "vision/surface"}},
    {"vision/paper",
     {"events", "vision/geometry", "vision/surface", "vision/correlation", "vision/contour",
      "vision/interfaces"}},
    {"vision/hypotheses",
     {"events", "vision/geometry", "vision/surface", "vision/contour", "vision/scene",
      "vision/interfaces"}},
    {"vision",
     {"events", "vision/geometry", "vision/surface", "vision/correlation", "vision/contour",
      "vision/scene", "vision/interfaces", "vision/paper", "vision/hypotheses"}},
    {"baselines", {"events", "vision"}},
    {"table", {"events", "vision/geometry"}},
    {"posix", {}},
    {"motion", {}},
    {"calibration",
     {"events", "vision/geometry", "vision/contour", "vision/hypotheses", "table", "motion"}},
    {"simulation", {"events", "vision/geometry", "table", "motion"}},
    {"evaluation", {"events", "vision/geometry", "vision/interfaces", "table"}},
    {"runtime", {"events", "vision"}},
    {"io",
     {"posix", "events", "vision/geometry", "vision/contour", "vision/hypotheses", "table",
      "motion"}},
    {"messages", {"events", "vision/geometry", "vision/interfaces", "table"}},
    {"messaging", {"posix", "events", "vision/geometry", "vision/interfaces", "table", "messages"}},
    {"recording", {"events", "io", "messaging"}},
    {"play", {"events", "vision/geometry", "table", "messages"}},
    {"control", {"events", "table", "motion", "runtime", "messages"}},
    {"yarp", {"posix", "control"}},
};

bool may_include(const std::string& part, const std::string& other) {
  const Parts& allowed = kAllowed.at(part);
  return other == part || allowed.contains(other) ||
         (other.starts_with("vision/") && allowed.contains("vision"));
}

// Adds what `part` may include, directly or through others.
void add_below(const std::string& part, Parts& below) {
  for (const std::string& other : kAllowed.at(part)) {
    if (below.insert(other).second) add_below(other, below);
  }
}

}  // namespace

TEST_CASE("every folder of common and room of vision includes only those below it") {
  const fs::path common = source_dir() / "common";
  for (const Include& include : includes_below(common)) {
    CAPTURE(include.file.string());
    const std::string part = part_of(include.file.lexically_relative(common));
    REQUIRE(kAllowed.contains(part));
    const bool is_own = include.target.starts_with("common/");
    const bool allowed = !is_own || may_include(part, part_of(include.target.substr(7)));
    CHECK_MESSAGE(allowed, include.file.string(), ":", include.line, " includes ", include.target);
    CHECK_MESSAGE(!include.target.starts_with("services/"), include.file.string());
    CHECK_MESSAGE(!include.target.starts_with("tools/"), include.file.string());
  }
}

TEST_CASE("the allowed includes have no cycle") {
  for (const auto& entry : kAllowed) {
    const std::string& part = entry.first;
    Parts below;
    add_below(part, below);
    CHECK_MESSAGE(!below.contains(part), part);
  }
}

TEST_CASE("the core knows no LCM, OpenCV, thread, wall clock, file or log") {
  const std::vector<std::string> forbidden{"lcm/",
                                           "puck/",
                                           "opencv2/",
                                           "spdlog/",
                                           "toml",
                                           "thread",
                                           "mutex",
                                           "atomic",
                                           "future",
                                           "chrono",
                                           "condition_variable",
                                           "ctime",
                                           "fstream",
                                           "iostream",
                                           "cstdio",
                                           "filesystem",
                                           "unistd.h",
                                           "sys/",
                                           "pthread",
                                           "time.h",
                                           "stdio.h",
                                           "shared_mutex"};
  for (const std::string folder : {"events", "vision", "baselines", "table"}) {
    for (const Include& include : includes_below(source_dir() / "common" / folder)) {
      CHECK_MESSAGE(!begins_with_any(include.target, forbidden), include.file.string(), ":",
                    include.line, " includes ", include.target);
      // Only the table's geometry and filter need matrices outside of the path of every event.
      const bool has_matrices = folder == "table" || !include.target.starts_with("Eigen/");
      CHECK_MESSAGE(has_matrices, include.file.string(), ":", include.line);
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

TEST_CASE("LCM's message types stay in messaging, recording and the tools") {
  std::string types;
  for (const auto& entry : fs::directory_iterator(source_dir() / "lcmtypes")) {
    if (entry.path().extension() != ".lcm") continue;
    types += (types.empty() ? "" : "|") + entry.path().stem().string();
  }
  const std::regex wire_type("\\b(" + types + ")\\b");
  CHECK(std::regex_search("  puck::arm_state_t state;", wire_type));
  CHECK(!std::regex_search("  ArmState arm_state;", wire_type));
  for (const std::string top : {"common", "services"}) {
    for (const auto& entry : fs::recursive_directory_iterator(source_dir() / top)) {
      const fs::path file = entry.path().lexically_relative(source_dir());
      const std::string folder = (++file.begin())->string();
      const bool is_edge = top == "common" && (folder == "messaging" || folder == "recording");
      if (is_edge || (file.extension() != ".h" && file.extension() != ".cpp")) continue;
      std::ifstream text(entry.path());
      std::string line;
      for (int number = 1; std::getline(text, line); ++number) {
        CHECK_MESSAGE(!std::regex_search(line, wire_type), file.string(), ":", number, ": ", line);
      }
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
                            (top == "tools" && (tool == "command_line" || tool == "charts"));
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
  CHECK(folder_of("tools/play/play_setup.h", "tools") == "play");
  CHECK(folder_of("vector", "tools").empty());
  CHECK(part_of("vision/geometry/region.h") == "vision/geometry");
  CHECK(part_of("vision/presets.h") == "vision");
  CHECK(part_of("events/event.h") == "events");
  CHECK(may_include("baselines", "vision/surface"));
  CHECK(!may_include("vision/surface", "vision"));
  CHECK(!may_include("vision/surface", "vision/paper"));
}

}  // namespace puck
