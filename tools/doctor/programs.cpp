#include "tools/doctor/programs.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>

#include <unistd.h>

#include "common/messaging/datagram.h"

namespace puck {
namespace {

namespace fs = std::filesystem;

template <typename Number>
std::optional<Number> number_of(const std::string& text) {
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Parses "socket:[4711]".
std::optional<std::uint64_t> socket_inode(const std::string& link) {
  constexpr std::string_view kBegin = "socket:[";
  if (!link.starts_with(kBegin) || !link.ends_with("]")) return std::nullopt;
  return number_of<std::uint64_t>(link.substr(kBegin.size(), link.size() - kBegin.size() - 1));
}

std::string name_of(const fs::path& process) {
  std::ifstream file(process / "comm");
  std::string name;
  std::getline(file, name);
  return printable(name);
}

}  // namespace

std::map<std::uint64_t, Program> find_programs(const std::set<std::uint64_t>& socket_inodes) {
  std::map<std::uint64_t, Program> programs;
  std::error_code error;
  for (const auto& process : fs::directory_iterator("/proc", error)) {
    const auto pid = number_of<int>(process.path().filename());
    // The doctor may have inherited sockets from its parent process.
    if (!pid || *pid == getpid()) continue;
    // A process may end meanwhile or belong to another user.
    std::error_code hidden;
    for (const auto& descriptor : fs::directory_iterator(process.path() / "fd", hidden)) {
      const fs::path link = fs::read_symlink(descriptor.path(), hidden);
      if (hidden) continue;
      const auto inode = socket_inode(link);
      if (inode && socket_inodes.contains(*inode)) {
        programs.try_emplace(*inode, Program{name_of(process.path()), *pid});
      }
    }
  }
  return programs;
}

}  // namespace puck
