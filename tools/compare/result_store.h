#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace puck {

/// What programs made, kept in folders NAME-HASH below one folder, found again by all that went
/// into it: the key. Safe from several threads, as long as no two make the same.
class ResultStore {
 public:
  /// Makes the folder, and clears away what an interrupted run left unfinished. Throws
  /// std::filesystem::filesystem_error.
  explicit ResultStore(std::filesystem::path folder);

  /// The folder of a result, if it has been made.
  std::optional<std::filesystem::path> find(const std::string& name, const std::string& key) const;

  /// `fill` makes the result in an empty folder. It is kept whole or, when `fill` throws, not at
  /// all; it takes the place of results of the same name with other keys, which are out of date.
  std::filesystem::path make(const std::string& name, const std::string& key,
                             const std::function<void(const std::filesystem::path&)>& fill);

  /// Nothing happens when there is none.
  void remove(const std::string& name, const std::string& key);

 private:
  std::filesystem::path path_of(const std::string& name, const std::string& key) const;

  std::filesystem::path folder_;
};

}  // namespace puck
