#pragma once

#include <ctime>
#include <filesystem>
#include <string>

namespace puck {

/// `pattern` with the conversions of strftime(3) filled in. Throws std::invalid_argument when
/// nothing or too much comes out.
std::string expand_log_path(const std::string& pattern, std::time_t time);

/// Names of the files of a rotated log: puck-2026-11-21-19-30-00.000000.lcm, ….000001.lcm and so
/// on, so that a list in the order of the names is one in the order of time.
class LogNames {
 public:
  /// `pattern` is what `path` was made from: it tells which other files are logs of this kind.
  LogNames(std::string pattern, const std::filesystem::path& path);

  std::filesystem::path at(int number) const;
  /// One more than the highest number that a file of this path has; 0 where there is none.
  int first_free() const;
  /// Whether this is the name of a file of a rotated log of this pattern, from whatever run.
  bool is_ours(const std::string& file_name) const;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::string pattern_;  // Without its folder.
  std::filesystem::path folder_;
  std::string stem_;
  std::string ending_;
};

}  // namespace puck
