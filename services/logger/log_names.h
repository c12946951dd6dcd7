#pragma once

#include <ctime>
#include <filesystem>
#include <string>

namespace puck {

/// Fills in the conversions of strftime(3) in `pattern`. Throws std::invalid_argument if the result
/// is empty or too long.
std::string expand_log_path(const std::string& pattern, std::time_t time);

/// File names of a rotated log: puck-2026-11-21-19-30-00.000000.lcm, ….000001.lcm and so on, so
/// that the alphabetical order is that of time.
class LogNames {
 public:
  /// `pattern`: the pattern of `path`, which identifies other logs of this kind.
  LogNames(std::string pattern, const std::filesystem::path& path);

  std::filesystem::path at(int number) const;
  /// The highest number of a file of this path plus 1; 0 without a file.
  int first_free() const;
  /// Whether this is the name of a rotated log of this pattern, from any run.
  bool is_ours(const std::string& file_name) const;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::string pattern_;  // Without its folder.
  std::filesystem::path folder_;
  std::string stem_;
  std::string ending_;
};

}  // namespace puck
