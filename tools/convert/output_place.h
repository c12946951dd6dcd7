#pragma once

#include <filesystem>
#include <string>

namespace puck {

/// Where a tool writes a file: a name beside the final one until the file is whole, so that a
/// failure or a signal leaves no part of it and an older file stays. One at a time.
class OutputPlace {
 public:
  /// `final`: "-" and what is no ordinary file, as a pipe, are written directly.
  explicit OutputPlace(const std::filesystem::path& final);
  /// Removes a file that was not kept.
  ~OutputPlace();
  OutputPlace(const OutputPlace&) = delete;
  OutputPlace& operator=(const OutputPlace&) = delete;

  /// Where to write.
  const std::filesystem::path& path() const { return part_; }

  /// A message of the writer, with the name that the user gave.
  std::string with_final_name(std::string message) const;

  /// Gives the file its final name. Throws std::filesystem::filesystem_error.
  void keep();

 private:
  std::filesystem::path final_;
  std::filesystem::path part_;
};

}  // namespace puck
