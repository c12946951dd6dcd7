#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace puck {

/// A cache of results, in folders NAME-HASH below one folder. The key holds all inputs of a result.
/// Safe from several threads that make different results.
class ResultStore {
 public:
  /// Creates the folder and removes unfinished results of an interrupted run. Throws
  /// std::filesystem::filesystem_error.
  explicit ResultStore(std::filesystem::path folder);

  /// The folder of a result; empty if there is none.
  std::optional<std::filesystem::path> find(const std::string& name, const std::string& key) const;

  /// `fill` makes the result in an empty folder; if it throws, nothing is kept. Removes results of
  /// the same name with other keys, which are out of date.
  std::filesystem::path make(const std::string& name, const std::string& key,
                             const std::function<void(const std::filesystem::path&)>& fill);

  /// Does nothing if there is no such result.
  void remove(const std::string& name, const std::string& key);

 private:
  std::filesystem::path path_of(const std::string& name, const std::string& key) const;

  std::filesystem::path folder_;
};

}  // namespace puck
